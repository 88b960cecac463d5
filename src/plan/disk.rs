//! Files a run will write, worked out before it starts, and the room there is for them.

use serde::Serialize;

use super::coupled::links;
use super::warning::Warning;
use crate::lattice::C;
use crate::scene::dry::DryScene;
use crate::scene::{Cadence, FieldChoice, Measure, Scene};
use crate::setup::{Face, Setup};
use crate::solver::boundary_cells::neighbour;

/// Bytes of a surface file per cell that the surface passes: a dozen triangles of 32 bytes and half as many points of 48.
const SURFACE_CELL: u64 = 800;
/// The same per link between fluid and grains: 490 grains of two cells.
const SURFACE_LINK: u64 = 40;
/// Bytes of a grain in a file, of a sphere of a clump, and of the contacts of a grain in a packing (three lines).
const GRAIN: u64 = 184;
const SPHERE: u64 = 88;
const CONTACTS: u64 = 336;
/// Bytes of a number in a table.
const NUMBER: u64 = 22;
/// Bytes of a file besides its numbers.
const HEAD: u64 = 2048;
/// Columns of a probe in the time series, on average.
const COLUMNS: u64 = 3;
/// Rows of the time series when the scene does not say.
const ROWS: u32 = 100;
/// Files or bytes above which a run is worth a warning.
const MANY_FILES: f64 = 1e5;
const MANY_BYTES: f64 = 2e10;

/// Files of one kind.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Files {
    /// What they hold.
    pub what: &'static str,
    /// How many.
    pub files: u64,
    /// Bytes of all of them, at the extent that the fluid has at time 0.
    pub bytes: u64,
}

/// How often something is written: at time 0, at the end, and between; once at the end without a cadence.
fn times(cadence: Option<Cadence>, end_s: f64, steps: u64) -> u64 {
    let between = match cadence {
        None => return 2,
        Some(Cadence::EverySeconds(every)) => (end_s / every).ceil(),
        Some(Cadence::Count(count)) => f64::from(count),
    };
    // Not more often than there are steps; a cast saturates.
    (between as u64).min(steps).saturating_add(1)
}

/// How many grains are written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grains {
    pub grains: usize,
    pub clumps: usize,
    pub spheres: usize,
}

impl Grains {
    /// Their files at so many times: grains, contacts, and spheres where there are clumps.
    fn files(self, times: u64) -> Files {
        let (kinds, clumps) = if self.clumps > 0 { (3, SPHERE * self.spheres as u64) } else { (2, 0) };
        let each = (GRAIN + CONTACTS) * self.grains as u64 + clumps + kinds * HEAD;
        Files {
            what: "grains and contacts",
            files: kinds.saturating_mul(times),
            bytes: times.saturating_mul(each),
        }
    }
}

/// Files of a scene without fluid.
#[must_use]
pub(super) fn dry(scene: &DryScene, grains: Grains, steps: u64) -> Vec<Files> {
    let (output, end) = (&scene.output, scene.stop.end_time_s);
    let series = series(output.series, output.probes.len(), end, steps);
    vec![grains.files(times(output.grains, end, steps)), series]
}

/// The time series.
fn series(cadence: Option<Cadence>, probes: usize, end_s: f64, steps: u64) -> Files {
    let rows = times(Some(cadence.unwrap_or(Cadence::Count(ROWS))), end_s, steps);
    let columns = 1 + COLUMNS * probes as u64;
    Files { what: "time series", files: 1, bytes: rows.saturating_mul(columns * NUMBER) }
}

/// Files of a scene with fluid.
#[must_use]
pub(super) fn flow(scene: &Scene, setup: &Setup, grains: Option<Grains>, steps: u64) -> Vec<Files> {
    let output = &scene.output;
    let end = scene.stop.end_time_s;
    let shots = times(output.fields, end, steps);
    let mut all = Vec::new();
    let mut add =
        |what, files: u64, each: u64| all.push(Files { what, files, bytes: files.saturating_mul(each) });
    add("fields", shots, FieldChoice::of(scene).bytes() + HEAD);
    if setup.free_surface.is_some() {
        add("surfaces", shots, surface_bytes(setup) + HEAD);
    }
    let [nx, ny, nz] = setup.extents.map(|n| n as u64);
    for (probe, _) in output.all_probes() {
        match probe.measure {
            Measure::Profile { along } => {
                add("profiles", shots, NUMBER * 8 * setup.extents[along.index()] as u64);
            }
            Measure::SurfaceProfile { along, .. } => {
                add("sections", shots, NUMBER * 7 * setup.extents[along.index()] as u64);
            }
            Measure::DepthMap { .. } => {
                let across = setup.extents[crate::scene::force::up(scene).0.index()] as u64;
                add("depth maps", shots, 24 * (nx * ny * nz / across) + HEAD);
            }
            _ => {}
        }
    }
    all.extend(
        grains.map(|grains| {
            grains.files(output.grains.map_or(shots, |cadence| times(Some(cadence), end, steps)))
        }),
    );
    all.push(series(output.series, output.all_probes().count(), end, steps));
    joined(all)
}

/// Kinds that occur several times as one.
fn joined(all: Vec<Files>) -> Vec<Files> {
    let mut out: Vec<Files> = Vec::new();
    for files in all {
        match out.iter_mut().find(|other| other.what == files.what) {
            Some(same) => {
                same.files = same.files.saturating_add(files.files);
                same.bytes = same.bytes.saturating_add(files.bytes);
            }
            None => out.push(files),
        }
    }
    out
}

/// Bytes of the mesh of the surface at time 0 in its file: around the fluid, and around grains in it.
pub(super) fn surface_bytes(setup: &Setup) -> u64 {
    let grains = setup.grains.as_ref().map_or(0.0, |grains| links(&grains.dem.grains, grains.units.dx_m));
    SURFACE_CELL * surface_cells(setup) + SURFACE_LINK * grains as u64
}

/// Cells of fluid at time 0 beside anything else, as the mesh closes at walls and solids.
fn surface_cells(setup: &Setup) -> u64 {
    let Some(surface) = &setup.free_surface else { return 0 };
    let wet = |cell: usize| !setup.is_solid(cell) && surface.fill[cell] > 0.0;
    let ends = |cell: usize, c: &[i32; 3]| match neighbour(setup, setup.coordinates(cell), *c) {
        Some(at) => !wet(setup.index(at)),
        None => {
            let axis = c.iter().position(|&c| c != 0).unwrap_or(0);
            setup.faces[axis][usize::from(c[axis] > 0)] != Face::FreeSlip
        }
    };
    let surface = |cell: &usize| wet(*cell) && C[1..7].iter().any(|c| ends(*cell, c));
    (0..setup.cells()).filter(surface).count() as u64
}

/// Bytes and number of all files.
#[must_use]
pub(super) fn total(files: &[Files]) -> (u64, u64) {
    files.iter().fold((0, 0), |(bytes, count), f| {
        (u64::saturating_add(bytes, f.bytes), u64::saturating_add(count, f.files))
    })
}

/// A warning where the files are more than the disk has room for, or many.
#[must_use]
pub(super) fn warning(files: &[Files], free: Option<u64>) -> Option<Warning> {
    let (bytes, count) = total(files);
    let largest = files.iter().max_by_key(|files| files.bytes)?.what;
    match free {
        Some(free) if bytes > free => Some(Warning::DiskFull { bytes, files: count, free, largest }),
        _ if bytes as f64 > MANY_BYTES || count as f64 > MANY_FILES => {
            Some(Warning::MuchOutput { bytes, files: count, largest })
        }
        _ => None,
    }
}

/// Bytes free on the disk of the folder the program was started in, where runs write unless they are told otherwise; `None`
/// where the system does not say.
#[cfg(unix)]
#[must_use]
pub(super) fn free() -> Option<u64> {
    let found = rustix::fs::statvfs(".").ok()?;
    found.f_bavail.checked_mul(found.f_frsize)
}

/// Bytes free on the disk; not known on this system.
#[cfg(not(unix))]
#[must_use]
pub(super) fn free() -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_times_of_a_cadence() {
        assert_eq!(times(Some(Cadence::EverySeconds(0.05)), 60.0, 35_763), 1201);
        assert_eq!(times(Some(Cadence::Count(5)), 60.0, 35_763), 6);
        assert_eq!(times(Some(Cadence::Count(100)), 60.0, 10), 11, "at most every step");
        assert_eq!(times(Some(Cadence::EverySeconds(1e-300)), 60.0, u64::MAX - 1), u64::MAX);
    }

    #[test]
    fn warnings_by_room_and_by_size() {
        let files = |bytes, files| [Files { what: "fields", files, bytes }];
        assert!(matches!(warning(&files(2000, 2), Some(1000)), Some(Warning::DiskFull { free: 1000, .. })));
        assert_eq!(warning(&files(1000, 2), Some(2000)), None);
        assert!(matches!(warning(&files(30_000_000_000, 2), None), Some(Warning::MuchOutput { .. })));
        assert!(matches!(warning(&files(1000, 200_000), None), Some(Warning::MuchOutput { .. })));
    }
}
