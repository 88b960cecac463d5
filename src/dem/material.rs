//! Materials in SI units and the table of what happens between two of them.

use super::DemError;
use super::contact::restitution::{linear_damping_ratio, tsuji_alpha};
use serde::{Deserialize, Serialize};

/// An isotropic elastic solid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Name used in messages.
    pub name: String,
    /// Density, kg/m3.
    pub density_kg_m3: f64,
    /// Young's modulus, Pa.
    pub young_pa: f64,
    /// Poisson's ratio, −1 < ν < 0.5.
    pub poisson: f64,
}

/// Law of the normal force \[D1\]. None of them ever attracts: the force is `max(0, ·)`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum NormalLaw {
    /// Hertz with Brilliantov's visco-elastic damping, F = k δ^{3/2} + (3/2) A k √δ δ̇: restitution falls with speed.
    ViscoElastic {
        /// Dissipative constant A of the pair, s.
        time_s: f64,
    },
    /// Hertz with Tsuji's damping, F = k δ^{3/2} + α √(m* k) δ^{1/4} δ̇: restitution does not depend on speed.
    Tsuji {
        /// Restitution that the collision really has, attraction cut off; 0 < e ≤ 1.
        restitution: f64,
    },
    /// Tsuji's law with the damping given as α ≥ 0.
    TsujiAlpha {
        /// α of the law.
        alpha: f64,
    },
    /// Linear spring and dashpot, F = k δ + c δ̇.
    Linear {
        /// Spring, N/m.
        stiffness_n_m: f64,
        /// Restitution that the collision really has, attraction cut off; 0 < e ≤ 1.
        restitution: f64,
        /// Tangential over normal stiffness.
        tangential_ratio: f64,
    },
}

/// What happens between two materials.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PairProperties {
    /// Law of the normal force.
    pub normal: NormalLaw,
    /// Coulomb's coefficient μ ≥ 0.
    pub friction: f64,
    /// Rolling friction coefficient μ_r ≥ 0: the torque against rolling and twisting is at most μ_r R* F_n.
    pub rolling_friction: f64,
    /// Tangential dashpot as a share of the normal one, ≥ 0; it acts while the contact sticks.
    pub tangential_damping: f64,
}

impl Default for PairProperties {
    fn default() -> Self {
        Self {
            normal: NormalLaw::Tsuji { restitution: 0.5 },
            friction: 0.5,
            rolling_friction: 0.0,
            tangential_damping: 1.0,
        }
    }
}

/// The materials of a scene and the properties of their pairs.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Materials {
    /// The materials; grains and walls name them by index.
    pub list: Vec<Material>,
    /// Properties of every pair that `pairs` does not list.
    pub default_pair: PairProperties,
    /// Exceptions: (first, second, properties), in either order.
    pub pairs: Vec<(usize, usize, PairProperties)>,
}

/// The normal law with what depends only on the pair of materials worked out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Compiled {
    /// A, s.
    ViscoElastic {
        /// A, s.
        time: f64,
    },
    /// α.
    Tsuji {
        /// α.
        alpha: f64,
    },
    /// Stiffness, N/m; damping ratio; tangential stiffness, N/m.
    Linear {
        /// Normal stiffness, N/m.
        stiffness: f64,
        /// Share of critical damping.
        ratio: f64,
        /// Tangential stiffness, N/m.
        tangential: f64,
    },
}

/// Everything the contact kernel needs to know about a pair of materials.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairLaw {
    /// Effective modulus E*, 1/E* = (1−ν₁²)/E₁ + (1−ν₂²)/E₂, Pa.
    pub young: f64,
    /// Effective shear modulus G*, 1/G* = (2−ν₁)/G₁ + (2−ν₂)/G₂, Pa.
    pub shear: f64,
    /// Law of the normal force.
    pub normal: Compiled,
    /// Coulomb's coefficient.
    pub friction: f64,
    /// Rolling friction coefficient.
    pub rolling: f64,
    /// Tangential dashpot as a share of the normal one.
    pub tangential_damping: f64,
}

/// Pair laws of all materials, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct PairTable {
    count: usize,
    laws: Vec<PairLaw>,
    /// Whether any pair resists rolling.
    pub any_rolling: bool,
}

impl PairTable {
    /// The law between materials `a` and `b`.
    #[inline(always)]
    pub fn law(&self, a: u32, b: u32) -> &PairLaw {
        &self.laws[a as usize * self.count + b as usize]
    }
}

impl Materials {
    /// One material with one set of pair properties.
    pub fn single(material: Material, pair: PairProperties) -> Self {
        Self { list: vec![material], default_pair: pair, pairs: Vec::new() }
    }

    /// Properties of the pair `a`, `b`; the last matching exception counts.
    pub(crate) fn properties(&self, a: usize, b: usize) -> PairProperties {
        let same = |&&(i, j, _): &&(usize, usize, PairProperties)| (i, j) == (a, b) || (j, i) == (a, b);
        self.pairs.iter().rev().find(same).map_or(self.default_pair, |p| p.2)
    }

    /// Checks everything and works out the table.
    ///
    /// # Errors
    /// E ≤ 0, ν outside (−1, 0.5), density ≤ 0, a pair property outside its range, an index without a material.
    pub fn compile(&self) -> Result<PairTable, DemError> {
        if self.list.is_empty() {
            return Err(DemError::NoMaterial);
        }
        for m in &self.list {
            check(m)?;
        }
        let count = self.list.len();
        for &(i, j, _) in &self.pairs {
            if i.max(j) >= count {
                return Err(DemError::UnknownMaterial { found: i.max(j), count });
            }
        }
        let mut alphas = Alphas::default();
        let mut laws = Vec::with_capacity(count * count);
        for a in 0..count {
            for b in 0..count {
                laws.push(pair_law(&self.list[a], &self.list[b], &self.properties(a, b), &mut alphas)?);
            }
        }
        let any_rolling = laws.iter().any(|l| l.rolling > 0.0);
        Ok(PairTable { count, laws, any_rolling })
    }
}

fn check(m: &Material) -> Result<(), DemError> {
    if !(m.young_pa > 0.0 && m.young_pa.is_finite()) {
        return Err(DemError::Young { name: m.name.clone(), found: m.young_pa });
    }
    if !(m.poisson > -1.0 && m.poisson < 0.5) {
        return Err(DemError::Poisson { name: m.name.clone(), found: m.poisson });
    }
    if !(m.density_kg_m3 > 0.0 && m.density_kg_m3.is_finite()) {
        return Err(DemError::Density { name: m.name.clone(), found: m.density_kg_m3 });
    }
    Ok(())
}

/// Tsuji's α of the restitutions met last: a root each, and most pairs of a table share one.
#[derive(Default)]
struct Alphas(Vec<[f64; 2]>);

impl Alphas {
    /// How many are kept.
    const KEPT: usize = 16;

    fn of(&mut self, restitution: f64) -> f64 {
        if let Some([_, alpha]) = self.0.iter().find(|[e, _]| *e == restitution) {
            return *alpha;
        }
        let alpha = tsuji_alpha(restitution);
        if self.0.len() == Self::KEPT {
            self.0.remove(0);
        }
        self.0.push([restitution, alpha]);
        alpha
    }
}

fn pair_law(a: &Material, b: &Material, p: &PairProperties, memo: &mut Alphas) -> Result<PairLaw, DemError> {
    let wrong = |what, found, allowed| {
        Err(DemError::PairProperty { first: a.name.clone(), second: b.name.clone(), what, found, allowed })
    };
    let within = |x: f64| x >= 0.0 && x.is_finite();
    for (what, value) in [
        ("friction", p.friction),
        ("rolling friction", p.rolling_friction),
        ("tangential damping", p.tangential_damping),
    ] {
        if !within(value) {
            return wrong(what, value, "0 or more");
        }
    }
    let restitution_ok = |e: f64| e > 0.0 && e <= 1.0;
    let normal = match p.normal {
        NormalLaw::ViscoElastic { time_s } if !within(time_s) => {
            return wrong("dissipative constant A", time_s, "0 s or more");
        }
        NormalLaw::ViscoElastic { time_s } => Compiled::ViscoElastic { time: time_s },
        NormalLaw::TsujiAlpha { alpha } if !within(alpha) => {
            return wrong("Tsuji's alpha", alpha, "0 or more");
        }
        NormalLaw::TsujiAlpha { alpha } => Compiled::Tsuji { alpha },
        NormalLaw::Tsuji { restitution } | NormalLaw::Linear { restitution, .. }
            if !restitution_ok(restitution) =>
        {
            return wrong("restitution", restitution, "above 0 and at most 1");
        }
        NormalLaw::Tsuji { restitution } => Compiled::Tsuji { alpha: memo.of(restitution) },
        NormalLaw::Linear { stiffness_n_m, restitution, tangential_ratio } => {
            if !(stiffness_n_m > 0.0 && stiffness_n_m.is_finite()) {
                return wrong("stiffness", stiffness_n_m, "above 0 N/m");
            }
            if !(tangential_ratio > 0.0 && tangential_ratio.is_finite()) {
                return wrong("tangential stiffness ratio", tangential_ratio, "above 0");
            }
            Compiled::Linear {
                stiffness: stiffness_n_m,
                ratio: linear_damping_ratio(restitution),
                tangential: tangential_ratio * stiffness_n_m,
            }
        }
    };
    let compliance = |m: &Material| (1.0 - m.poisson * m.poisson) / m.young_pa;
    // G = E/(2(1+nu)), so (2-nu)/G = 2(2-nu)(1+nu)/E.
    let shear_compliance = |m: &Material| 2.0 * (2.0 - m.poisson) * (1.0 + m.poisson) / m.young_pa;
    Ok(PairLaw {
        young: 1.0 / (compliance(a) + compliance(b)),
        shear: 1.0 / (shear_compliance(a) + shear_compliance(b)),
        normal,
        friction: p.friction,
        rolling: p.rolling_friction,
        tangential_damping: p.tangential_damping,
    })
}
