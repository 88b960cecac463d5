use super::super::quadrature::tanh_sinh;
use super::*;
use crate::reference_values::find;

fn thesis() -> InclineRest {
    InclineRest::new(58.0, 997.45, 9.81, 16.0 * core::f64::consts::PI / 180.0).unwrap()
}

#[test]
fn incline_profile_balances_stress_along_the_bed() {
    let rest = thesis();
    for (edge, sign, depths) in
        [(Edge::Downhill, 1.0, [1e-6, 0.002, 0.0214]), (Edge::Uphill, -1.0, [1e-6, 0.01, 0.5])]
    {
        for h in depths {
            let step: f64 = 1e-5 * f64::min(h, (rest.critical_depth - h).abs());
            let run = rest.distance(edge, h + step) - rest.distance(edge, h - step);
            // ∂h/∂x along the slope: falling to the front, rising from the rear.
            let rise = -sign * 2.0 * step / run;
            let stress = h * (libm::sin(rest.slope) - libm::cos(rest.slope) * rise);
            let yielding = rest.critical_depth * libm::sin(rest.slope);
            // The difference quotient: (1e-5)² truncation and 1e-16/1e-5 rounding.
            assert!((stress / (sign * yielding) - 1.0).abs() < 1e-8, "{edge:?} {h} {stress}");
        }
    }
}

#[test]
fn incline_depth_inverts_distance_and_area_integrates_it() {
    let rest = thesis();
    for edge in [Edge::Downhill, Edge::Uphill] {
        for distance in [1e-9, 1e-4, 0.03, 0.4] {
            let h = rest.depth(edge, distance);
            let back = rest.distance(edge, h);
            // One bit of h is worth |dx/dh| of distance; near h_c that is 1e-16 h_c²/(h_c − h).
            assert!((back / distance - 1.0).abs() < 1e-8, "{edge:?} {distance} {back}");
            let area = tanh_sinh(0.0, distance, |x| rest.depth(edge, x));
            // The rule's own 1e-13 with the rounding of the bisection on top.
            assert!((rest.area(edge, h) / area - 1.0).abs() < 1e-9, "{edge:?} {distance} {area}");
        }
        assert_eq!((rest.depth(edge, 0.0), rest.depth(edge, -1.0)), (0.0, 0.0));
    }
    assert_eq!(rest.distance(Edge::Downhill, rest.critical_depth), f64::INFINITY);
}

#[test]
fn limit_of_a_small_edge_is_the_horizontal_deposit() {
    // h² = 2 h_c tan θ x = 2 σ0 x/(ρ g cos θ) for h ≪ h_c, next term relative h/h_c.
    let rest = thesis();
    let distance = 1e-9;
    let parabola = (2.0 * rest.critical_depth * libm::tan(rest.slope) * distance).sqrt();
    for edge in [Edge::Downhill, Edge::Uphill] {
        let ratio = rest.depth(edge, distance) / parabola;
        assert!((ratio - 1.0).abs() < parabola / rest.critical_depth, "{ratio}");
    }
}

#[test]
fn reference_round_deposit() {
    let entry = find("slump_axisym_R", &[]).unwrap();
    let input = |name| entry.input(name).unwrap();
    let (stress, density, volume) = (input("sigma_y"), input("rho"), input("V"));
    let rest = SpreadRest::round(stress, density, 9.81, volume).unwrap();
    let close = |computed: f64, field| {
        let reference = entry.field(field).unwrap();
        // One unit of the last digit stated.
        assert!((computed / reference - 1.0).abs() < entry.tolerance(), "{field} {computed}");
    };
    close(rest.edge(), "R");
    close(rest.height(0.0), "h0");
    close(rest.height(0.0) / rest.edge(), "ratio_h_over_R");
    let two_pi = 2.0 * core::f64::consts::PI;
    let held = two_pi * tanh_sinh(0.0, rest.edge(), |r| r * rest.height(r));
    // (R − r) formed by subtraction loses digits in a vanishing share of the integral.
    assert!((held / volume - 1.0).abs() < 1e-10, "{held}");
}

#[test]
fn planar_deposit_holds_its_area() {
    let rest = SpreadRest::planar(50.0, 2000.0, 9.81, 0.003).unwrap();
    let area = tanh_sinh(0.0, rest.edge(), |x| rest.height(x));
    // As for the round one.
    assert!((area / 0.003 - 1.0).abs() < 1e-10, "{area}");
    assert_eq!(rest.height(1.01 * rest.edge()), 0.0);
}

fn column(top: f64, base: f64, tau: f64, criterion: Criterion) -> TallColumn {
    TallColumn {
        height: 0.3,
        radius_top: top,
        radius_base: base,
        yield_stress: tau * 1500.0 * 9.81 * 0.3,
        density: 1500.0,
        gravity: 9.81,
        criterion,
    }
}

#[test]
fn paper_pashias1996_cylinder() {
    for tau in [0.01, 0.1, 0.3, 0.49] {
        let s = column(0.1, 0.1, tau, Criterion::Tresca).collapse().unwrap().slump / 0.3;
        // Rounding of 1 − … near τ′ = ½, where s → 0.
        assert!((s - (1.0 - 2.0 * tau * (1.0 - libm::log(2.0 * tau)))).abs() < 1e-14, "{tau} {s}");
    }
    assert_eq!(column(0.1, 0.1, 0.51, Criterion::Tresca).collapse().unwrap().slump, 0.0);
}

#[test]
fn paper_clayton2003_cone() {
    // The standard cone, base radius twice the top's: with u = 1 + z0/H,
    // τ′ = (u − u⁻²)/6 and s′ = 2 − u − 2τ′ ln(7/(u³ − 1)).
    for u in [1.05, 1.3, 1.9] {
        let tau = (u - 1.0 / (u * u)) / 6.0;
        let collapsed = column(0.05, 0.1, tau, Criterion::Tresca).collapse().unwrap();
        let s = 2.0 - u - 2.0 * tau * libm::log(7.0 / (u * u * u - 1.0));
        // Rounding, ten-fold for the bisected z0.
        assert!((collapsed.slump / 0.3 - s).abs() < 1e-14, "{u} {collapsed:?} {s}");
        assert!((collapsed.unyielded / 0.3 - (u - 1.0)).abs() < 1e-14);
    }
}

#[test]
fn collapse_conserves_volume_slice_by_slice() {
    for (top, base) in [(0.0, 0.1), (0.05, 0.1), (0.1, 0.1), (0.1, 0.06)] {
        let cone = column(top, base, 0.07, Criterion::VonMises);
        let end = cone.collapse().unwrap();
        let strength = Criterion::VonMises.factor() * cone.yield_stress;
        let thinned = tanh_sinh(end.unyielded, 0.3, |z| strength / cone.stress(z));
        // Quadrature 1e-13; the sum is of the height itself.
        assert!((end.unyielded + thinned - end.height).abs() < 1e-12, "{top} {base} {end:?}");
        let weight = cone.density * cone.gravity * cone.volume_over_pi(0.3);
        let base_stress = weight / (end.base_radius * end.base_radius);
        // Rounding.
        assert!((base_stress / strength - 1.0).abs() < 1e-14);
    }
}

#[test]
fn reference_unyielded_cylinder_top() {
    let entry = find("slump_RC_elongational_final_height", &[]).unwrap();
    let (stress, density) = (entry.input("sigma_y").unwrap(), entry.input("rho").unwrap());
    let cylinder = TallColumn { yield_stress: stress, density, ..column(0.1, 0.1, 1.0, Criterion::VonMises) };
    let top = cylinder.collapse().unwrap().unyielded;
    assert!((top / entry.number().unwrap() - 1.0).abs() < entry.tolerance(), "{top}");
}

#[test]
fn refuses_bad_input() {
    assert!(InclineRest::new(1.0, 1.0, 1.0, 0.0).is_err());
    assert!(InclineRest::new(1.0, 1.0, 1.0, 1.6).is_err());
    assert!(SpreadRest::round(0.0, 1.0, 1.0, 1.0).is_err());
    assert!(SpreadRest::planar(1.0, 1.0, 1.0, f64::NAN).is_err());
    assert!(column(-0.1, 0.1, 0.1, Criterion::Tresca).collapse().is_err());
    assert!(column(0.1, 0.0, 0.1, Criterion::Tresca).collapse().is_err());
}
