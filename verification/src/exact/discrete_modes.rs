//! Exact damping and speed of plane waves on the D3Q19 lattice, from the linearised scheme itself.
//!
//! The scheme is written down here from its textbook definition, independently of the rest of the
//! program. A wave f = f̂ e^{ik·x} is multiplied each step by e^{−ik·c} C, C the linearised
//! collision. Reflections that leave k and the mean flow alone split the 19 populations into
//! sectors of at most nine; the physical wave is followed in its sector from k = 0.

use faer::{Mat, c64};

use super::ExactError;

/// The relaxation of the scheme: even populations with τ⁺, odd with τ⁻; BGK has τ⁻ = τ⁺.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relaxation {
    /// τ⁺ > ½.
    pub even: f64,
    /// τ⁻ > ½.
    pub odd: f64,
}

impl Relaxation {
    /// One relaxation time.
    pub fn bgk(tau: f64) -> Self {
        Self { even: tau, odd: tau }
    }

    /// Two, with (τ⁺ − ½)(τ⁻ − ½) = Λ.
    pub fn trt(tau: f64, magic: f64) -> Self {
        Self { even: tau, odd: 0.5 + magic / (tau - 0.5) }
    }

    /// ν = (τ⁺ − ½)/3.
    pub fn viscosity(&self) -> f64 {
        (self.even - 0.5) / 3.0
    }
}

/// The direction of a transverse wave and of its velocity. The lattice symmetries make all other
/// choices of axes equal to one of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shear {
    /// k = (k, 0, 0), u along y.
    Axis,
    /// k = (k, k, 0), u along (1, −1, 0).
    DiagonalInPlane,
    /// k = (k, k, 0), u along z.
    DiagonalOutOfPlane,
}

type Velocity = [i32; 3];
type Reflection = (fn(Velocity) -> Velocity, f64);

const FLIP_Y: fn(Velocity) -> Velocity = |c| [c[0], -c[1], c[2]];
const FLIP_Z: fn(Velocity) -> Velocity = |c| [c[0], c[1], -c[2]];
const SWAP_XY: fn(Velocity) -> Velocity = |c| [c[1], c[0], c[2]];
const SWAP_YZ: fn(Velocity) -> Velocity = |c| [c[0], c[2], c[1]];

/// Factor e^{−iω} per time step of a transverse wave of components 2π/`wavelength` along the axes of
/// its wave vector, as (real, imaginary); in a mean flow `mean_flow` along x (only for
/// [`Shear::Axis`]; the reflections of the diagonal waves need a fluid at rest).
///
/// # Errors
/// `Argument` outside τ > ½, wavelength ≥ 2, or a mean flow with a diagonal wave.
pub fn shear_factor(
    shear: Shear,
    relaxation: Relaxation,
    wavelength: f64,
    mean_flow: f64,
) -> Result<(f64, f64), ExactError> {
    check(relaxation, wavelength)?;
    if mean_flow != 0.0 && shear != Shear::Axis {
        let allowed = "must be 0 for a diagonal wave";
        return Err(ExactError::Argument { what: "mean_flow", value: mean_flow, allowed });
    }
    let (direction, reflections): ([f64; 3], &[Reflection]) = match shear {
        Shear::Axis => ([1.0, 0.0, 0.0], &[(FLIP_Y, -1.0), (FLIP_Z, 1.0)]),
        Shear::DiagonalInPlane => ([1.0, 1.0, 0.0], &[(SWAP_XY, -1.0), (FLIP_Z, 1.0)]),
        Shear::DiagonalOutOfPlane => ([1.0, 1.0, 0.0], &[(SWAP_XY, 1.0), (FLIP_Z, -1.0)]),
    };
    let sector = Sector::new(reflections, relaxation, mean_flow);
    let followed = sector.follow(direction, core::f64::consts::TAU / wavelength, |k| {
        let damping = relaxation.viscosity() * k * k * (direction[0] + direction[1]);
        polar(-damping, -k * mean_flow)
    })?;
    Ok((followed.re, followed.im))
}

/// Effective over nominal viscosity of a transverse wave, −ln|λ|/(νk²), λ its factor per step.
///
/// At large νk² the shear mode can meet a kinetic mode and become an oscillating pair; |λ| then still
/// gives its decay.
///
/// # Errors
/// `Argument` outside τ > ½, wavelength ≥ 2, or a mean flow with a diagonal wave.
pub fn shear_viscosity_ratio(
    shear: Shear,
    relaxation: Relaxation,
    wavelength: f64,
    mean_flow: f64,
) -> Result<f64, ExactError> {
    let (re, im) = shear_factor(shear, relaxation, wavelength, mean_flow)?;
    let k = core::f64::consts::TAU / wavelength;
    let k2 = if shear == Shear::Axis { k * k } else { 2.0 * k * k };
    Ok(-0.5 * libm::log(re * re + im * im) / (relaxation.viscosity() * k2))
}

/// Discrete speed (lattice units) and amplitude decay rate over νk² of a sound wave along x in a
/// fluid at rest.
///
/// # Errors
/// `Argument` outside τ > ½, wavelength ≥ 2.
pub fn sound(relaxation: Relaxation, wavelength: f64) -> Result<(f64, f64), ExactError> {
    check(relaxation, wavelength)?;
    let sector = Sector::new(&[(FLIP_Y, 1.0), (FLIP_Z, 1.0), (SWAP_YZ, 1.0)], relaxation, 0.0);
    let k = core::f64::consts::TAU / wavelength;
    let factor = sector
        .follow([1.0, 0.0, 0.0], k, |k| polar(-relaxation.viscosity() * k * k, -k * libm::sqrt(1.0 / 3.0)))?;
    let speed = -libm::atan2(factor.im, factor.re) / k;
    let decay = -0.5 * libm::log(factor.re * factor.re + factor.im * factor.im);
    Ok((speed, decay / (relaxation.viscosity() * k * k)))
}

fn check(relaxation: Relaxation, wavelength: f64) -> Result<(), ExactError> {
    for (what, value) in [("tau_even", relaxation.even), ("tau_odd", relaxation.odd)] {
        if value.is_nan() || value <= 0.5 {
            return Err(ExactError::Argument { what, value, allowed: "must exceed 1/2" });
        }
    }
    if wavelength.is_nan() || wavelength < 2.0 {
        let allowed = "must be at least 2 cells";
        return Err(ExactError::Argument { what: "wavelength", value: wavelength, allowed });
    }
    Ok(())
}

fn polar(log_size: f64, angle: f64) -> c64 {
    let size = libm::exp(log_size);
    c64::new(size * libm::cos(angle), size * libm::sin(angle))
}

fn dot(c: Velocity, v: [f64; 3]) -> f64 {
    f64::from(c[0]) * v[0] + f64::from(c[1]) * v[1] + f64::from(c[2]) * v[2]
}

fn velocities() -> Vec<Velocity> {
    let mut all = Vec::with_capacity(19);
    for x in -1..=1 {
        for y in -1..=1 {
            for z in -1..=1 {
                if x * x + y * y + z * z <= 2 {
                    all.push([x, y, z]);
                }
            }
        }
    }
    all
}

fn weight(c: Velocity) -> f64 {
    match c[0] * c[0] + c[1] * c[1] + c[2] * c[2] {
        0 => 1.0 / 3.0,
        1 => 1.0 / 18.0,
        _ => 1.0 / 36.0,
    }
}

/// Linearised equilibrium response of population c to one unit of population d in a flow U:
/// w \[δρ + 3c·δj + 9(c·U)(c·δj) − (9/2)(c·U)²δρ − 3U·δj + (3/2)U²δρ\], δρ = 1, δj = d.
fn equilibrium_response(c: Velocity, d: Velocity, mean_flow: [f64; 3]) -> f64 {
    let cd = f64::from(c[0] * d[0] + c[1] * d[1] + c[2] * d[2]);
    let (cu, du) = (dot(c, mean_flow), dot(d, mean_flow));
    let u2 = mean_flow.iter().map(|u| u * u).sum::<f64>();
    weight(c) * (1.0 + 3.0 * cd + 9.0 * cu * cd - 4.5 * cu * cu - 3.0 * du + 1.5 * u2)
}

/// (C)_{cd}: relaxation of the even and odd parts, each with its own time.
fn collision(c: Velocity, d: Velocity, relaxation: Relaxation, mean_flow: [f64; 3]) -> f64 {
    let opposite = [-c[0], -c[1], -c[2]];
    let unit = |a: Velocity| if a == d { 1.0 } else { 0.0 };
    let departure = |a: Velocity| unit(a) - equilibrium_response(a, d, mean_flow);
    let even = 0.5 * (departure(c) + departure(opposite));
    let odd = 0.5 * (departure(c) - departure(opposite));
    unit(c) - even / relaxation.even - odd / relaxation.odd
}

/// The populations of one symmetry: basis vectors are signed orbits of a representative velocity.
struct Sector {
    representatives: Vec<Velocity>,
    /// Collision between orbits, `[to][from]`.
    collision: Vec<Vec<f64>>,
}

impl Sector {
    fn new(reflections: &[Reflection], relaxation: Relaxation, mean_flow: f64) -> Self {
        let all = velocities();
        let mean_flow = [mean_flow, 0.0, 0.0];
        let mut seen: Vec<Velocity> = Vec::new();
        let mut orbits: Vec<Vec<(Velocity, f64)>> = Vec::new();
        for c in &all {
            if seen.contains(c) {
                continue;
            }
            let orbit = orbit(*c, reflections);
            seen.extend(orbit.iter().map(|(member, _)| *member));
            // A velocity that a reflection maps on itself with sign −1 has no place in the sector.
            if orbit
                .iter()
                .all(|(member, sign)| orbit.contains(&(*member, *sign)) && !orbit.contains(&(*member, -sign)))
            {
                orbits.push(orbit);
            }
        }
        let representatives: Vec<Velocity> =
            orbits.iter().filter_map(|o| o.first().map(|(c, _)| *c)).collect();
        let collision = representatives
            .iter()
            .map(|to| {
                let from = |orbit: &Vec<(Velocity, f64)>| {
                    orbit
                        .iter()
                        .map(|(d, sign)| sign * collision(*to, *d, relaxation, mean_flow))
                        .sum::<f64>()
                };
                orbits.iter().map(from).collect()
            })
            .collect();
        Self { representatives, collision }
    }

    fn eigenvalues(&self, wave: [f64; 3]) -> Result<Vec<c64>, ExactError> {
        let size = self.representatives.len();
        let matrix = Mat::<c64>::from_fn(size, size, |i, j| {
            let shift = polar(0.0, -dot(self.representatives[i], wave));
            c64::new(shift.re * self.collision[i][j], shift.im * self.collision[i][j])
        });
        matrix.eigenvalues().map_err(|_| ExactError::Eigenvalues { size })
    }

    /// The eigenvalue that starts as `hydrodynamic` near k = 0, followed to `k` in small steps.
    fn follow(
        &self,
        direction: [f64; 3],
        k: f64,
        hydrodynamic: impl Fn(f64) -> c64,
    ) -> Result<c64, ExactError> {
        const STEPS: u32 = 400;
        let mut previous = c64::new(1.0, 0.0);
        let mut current = previous;
        for step in 1..=STEPS {
            let here = k * f64::from(step) / f64::from(STEPS);
            let expected = if step == 1 {
                hydrodynamic(here)
            } else {
                c64::new(2.0 * current.re - previous.re, 2.0 * current.im - previous.im)
            };
            let distance = |z: &c64| {
                (z.re - expected.re) * (z.re - expected.re) + (z.im - expected.im) * (z.im - expected.im)
            };
            let values = self.eigenvalues(direction.map(|d| d * here))?;
            let nearest = values.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            previous = current;
            current = *nearest.ok_or(ExactError::Eigenvalues { size: 0 })?;
        }
        Ok(current)
    }
}

/// All images of c under the reflections, with the product of their signs.
fn orbit(c: Velocity, reflections: &[Reflection]) -> Vec<(Velocity, f64)> {
    let mut members = vec![(c, 1.0)];
    let mut next = 0;
    while let Some((member, sign)) = members.get(next).copied() {
        for (reflect, character) in reflections {
            let image = (reflect(member), sign * character);
            if !members.contains(&image) {
                members.push(image);
            }
        }
        next += 1;
    }
    members
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference_values::{Entry, all, find};

    fn relaxation_of(entry: &Entry) -> Relaxation {
        let tau = entry.input("tau").unwrap();
        match entry.input_text("op").unwrap() {
            "BGK" => Relaxation::bgk(tau),
            "TRT3/16" => Relaxation::trt(tau, 3.0 / 16.0),
            "TRT1/4" => Relaxation::trt(tau, 0.25),
            other => unreachable!("{other}"),
        }
    }

    /// Both polarisations of the table's wave.
    fn waves_of(entry: &Entry) -> &'static [Shear] {
        match entry.input_text("k").unwrap() {
            "axis" => &[Shear::Axis],
            _ => &[Shear::DiagonalInPlane, Shear::DiagonalOutOfPlane],
        }
    }

    #[test]
    fn reference_table() {
        let mut compared = 0;
        for entry in all("shear_wave_nu_ratio").unwrap().filter(|entry| entry.note.is_empty()) {
            let (n, reference) = (entry.input("N").unwrap(), entry.number().unwrap());
            for wave in waves_of(entry) {
                let ratio = shear_viscosity_ratio(*wave, relaxation_of(entry), n, 0.0).unwrap();
                // The table's eight digits: half a unit of the last.
                assert!(
                    (ratio / reference - 1.0).abs() < 0.5 * 1e-7,
                    "{:?}: {ratio} {reference}",
                    entry.inputs
                );
            }
            compared += 1;
        }
        assert_eq!(compared, 135);
    }

    /// The nine entries of the table that carry a note took another eigenvalue than the shear mode's.
    #[test]
    fn reference_entries_with_a_note_are_not_the_shear_mode() {
        let mut noted = 0;
        for entry in all("shear_wave_nu_ratio").unwrap().filter(|entry| !entry.note.is_empty()) {
            noted += 1;
            let (n, reference) = (entry.input("N").unwrap(), entry.number().unwrap());
            let k = core::f64::consts::TAU / n;
            for wave in waves_of(entry) {
                let relaxation = relaxation_of(entry);
                let ratio = shear_viscosity_ratio(*wave, relaxation, n, 0.0).unwrap();
                assert!((ratio / reference - 1.0).abs() > 1e-2);
                if relaxation.even == 1.0 {
                    // At τ = 1 the step is a plain average of equilibria; with −ln of
                    // 3 Σ w (c·t)² e^{−ik·c} = (1 + 2 cos k)/3 for unit t across k.
                    let exact = -libm::log((1.0 + 2.0 * libm::cos(k)) / 3.0) / (k * k / 3.0);
                    // The eigenvalue solver's rounding over νk² = 0.05.
                    assert!((ratio / exact - 1.0).abs() < 1e-12, "{ratio} {exact}");
                }
            }
        }
        assert_eq!(noted, 9);
    }

    #[test]
    fn reference_galilean_defect() {
        for entry in all("galilean_shear_nu_ratio_k_par_U").unwrap() {
            let u = entry.input("U").unwrap();
            let relaxation = Relaxation::bgk(entry.input("tau").unwrap());
            let ratio = shear_viscosity_ratio(Shear::Axis, relaxation, entry.input("wavelength").unwrap(), u)
                .unwrap();
            assert!((ratio / entry.number().unwrap() - 1.0).abs() < entry.tolerance(), "{ratio}");
        }
    }

    #[test]
    fn reference_sound_damping() {
        let entry = find("sound_decay_over_nu_k2", &[]).unwrap();
        let relaxation = Relaxation::bgk(entry.input("tau").unwrap());
        let (speed, decay) = sound(relaxation, entry.input("wavelength").unwrap()).unwrap();
        assert!((decay / entry.number().unwrap() - 1.0).abs() < entry.tolerance(), "{decay}");
        // Dispersion of order (k c_s)²: 2e-4.
        assert!((speed * libm::sqrt(3.0) - 1.0).abs() < 2e-4, "{speed}");
    }
}
