//! A block of spheres let go on a rough bed, until it rests and after.

use super::support::{Known, Matter, bed, free, gate, liveliest};
use lahar::dem::{Dem, DemError, Energies, Setup, V3};

/// Steps between looks at the kinetic energy.
const LOOK: u64 = 250;
/// Steps that the heap is watched after it has come to rest.
pub const AFTER: u64 = 20_000;
/// Kinetic energy below which a heap is taken to rest, as a share of the largest. The energy falls in beats ten times
/// as high as their valleys, so the watch for 1e-12 begins a hundred times lower.
pub const REST: f64 = 1e-14;
/// Longest fall and settling that is waited for, s.
const LONGEST: f64 = 10.0;

/// How a heap came to rest.
#[derive(Clone, Debug)]
pub struct Rest {
    /// Free grains.
    pub grains: usize,
    /// s; when the kinetic energy fell below [`REST`] of its largest; NaN if it did not.
    pub time: f64,
    /// Steps until then.
    pub steps: u64,
    /// Largest kinetic energy in the [`AFTER`] steps after that, as a share of the largest before.
    pub after: f64,
    /// Largest displacement of a grain in those steps, m.
    pub moved: f64,
    /// Kinetic energy of the liveliest grain at the end, m g R.
    pub liveliest: f64,
    /// Contacts with other grains (free or of the bed) per free grain, a contact between two free ones counted once.
    pub contacts: f64,
    /// Energy that the books miss, as a share of the energy lost: at rest.
    pub missing: f64,
    /// The books at rest.
    pub books: Energies,
    /// Lowest centre of a free grain at the end, m: below zero it has left the bed.
    pub lowest: f64,
    /// Kinetic energy as a share of its largest against time, s.
    pub history: Vec<[f64; 2]>,
}

/// Heaps computed so far in this process; claims and exhibits ask for the same ones.
static KNOWN: Known<Rest> = Known::nothing();

/// A cube of `edge`³ spheres above its bed, and their number.
fn cube(edge: u32, matter: &Matter) -> Result<(Setup, usize), DemError> {
    let side = matter.cell() * f64::from(edge) * (1.0 + 1e-9);
    let matter = matter.taller(f64::from(edge) / 10.0);
    let mut s = matter.slice(side)?;
    s.grains = matter.block(-0.5 * side, 0.5 * side, side, side, 9)?;
    let grains = s.grains.len();
    s.grains.extend(bed(-2.5 * side, 2.5 * side, side));
    // A sphere that rolled off the end of the bed would fall for ever.
    s.walls = vec![gate(-2.5 * side, 1.0, "left"), gate(2.5 * side, -1.0, "right")];
    Ok((s, grains))
}

/// Energy that the books miss after `seconds`, as a share of the energy lost, and the books.
///
/// # Errors
/// What the grains refuse.
pub fn missing(edge: u32, matter: &Matter, seconds: f64) -> Result<(f64, Energies), DemError> {
    let (s, _) = cube(edge, matter)?;
    let mut d = Dem::new(&s)?;
    let start = d.energies().balance();
    d.step((seconds / d.time_step()).round() as u64)?;
    let books = d.energies();
    Ok(((books.balance() - start) / books.lost(), books))
}

/// Releases a cube of `edge`³ spheres.
///
/// # Errors
/// What the grains refuse.
pub fn release(edge: u32, matter: &Matter) -> Result<Rest, DemError> {
    KNOWN.get(&format!("{edge} {matter:?}"), || fall(edge, matter))
}

fn fall(edge: u32, matter: &Matter) -> Result<Rest, DemError> {
    let (s, grains) = cube(edge, matter)?;
    let mut d = Dem::new(&s)?;
    let start = d.energies().balance();
    let mut most = d.kinetic_energy();
    let mut history = vec![(0.0, most)];
    let mut time = f64::NAN;
    while d.time() < LONGEST {
        d.step(LOOK)?;
        let k = d.kinetic_energy();
        history.push((d.time(), k));
        most = most.max(k);
        if k < REST * most {
            time = d.time();
            break;
        }
    }
    let (steps, books) = (d.steps(), d.energies());
    let before: Vec<V3> = d.bodies().position.clone();
    let mut after = 0.0f64;
    for _ in 0..AFTER / LOOK {
        d.step(LOOK)?;
        let k = d.kinetic_energy();
        history.push((d.time(), k));
        after = after.max(k / most);
    }
    let b = d.bodies();
    let moved = before.iter().zip(&b.position).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    let lowest = (0..b.len()).filter(|&i| free(&d, i)).map(|i| b.position[i].z).fold(f64::MAX, f64::min);
    Ok(Rest {
        grains,
        time,
        steps,
        after: if time.is_nan() { f64::NAN } else { after },
        moved,
        liveliest: liveliest(&d),
        contacts: d.pair_counts().1 as f64 / grains as f64,
        missing: (books.balance() - start) / books.lost(),
        books,
        lowest,
        history: history.iter().map(|(t, k)| [*t, k / most]).collect(),
    })
}
