//! Consistency of a [`Setup`] before anything is allocated.

use super::run::StartError;
use crate::boundary::links::{MAX_CELLS, boundary_cell};
use crate::setup::{Course, Face, Setup};

/// Checks lengths, table entries, faces and size.
///
/// # Errors
/// The first inconsistency found.
pub(crate) fn check(setup: &Setup) -> Result<(), StartError> {
    // Three of the largest extents overflow even 128 bits.
    let cells = setup.extents.iter().fold(1_u128, |cells, &n| cells.saturating_mul(n as u128));
    if cells > u128::from(MAX_CELLS) {
        return Err(StartError::TooManyCells { cells, max: MAX_CELLS });
    }
    if cells == 0 || setup.fluids.is_empty() {
        return Err(StartError::NoFluid);
    }
    for (axis, faces) in ['x', 'y', 'z'].into_iter().zip(setup.faces) {
        if (faces[0] == Face::Periodic) != (faces[1] == Face::Periodic) {
            return Err(StartError::HalfPeriodic { axis });
        }
        let index = usize::from(axis as u8 - b'x');
        for face in faces {
            if let Face::Moving(velocity) = face
                && velocity[index] != 0.0
            {
                return Err(StartError::FaceLeaves { axis, found: velocity[index] });
            }
        }
        if faces.contains(&Face::Open) && setup.free_surface.is_none() {
            return Err(StartError::OpenWithoutSurface { axis });
        }
    }
    table(setup, "solids", &setup.solids, "solid_motion", setup.solid_motion.len() + 1)?;
    table(setup, "fluid_of_cell", &setup.fluid_of_cell, "fluids", setup.fluids.len())?;
    if !setup.solids.is_empty() && setup.solids.iter().all(|&s| s != 0) {
        return Err(StartError::NoFluid);
    }
    if !setup.courses.all().all(Course::is_sound) {
        return Err(StartError::Course);
    }
    cuts(setup)?;
    surface(setup)
}

/// Cut cells come in order, are not solid, and have shares from 0 to 1.
fn cuts(setup: &Setup) -> Result<(), StartError> {
    if !setup.cuts.is_empty() && !setup.can_be_cut() {
        return Err(StartError::CutsInMotion);
    }
    let mut before = None;
    for cut in setup.cuts.iter() {
        let cell = cut.cell as usize;
        let wrong = |what| Err(StartError::Cut { cell, what });
        if before.is_some_and(|before| before >= cell) {
            return wrong("does not come after the cell before it");
        }
        if cell >= setup.cells() || setup.is_solid(cell) {
            return wrong("is no fluid cell of the box");
        }
        if boundary_cell(setup, cell).is_none_or(|record| !record.touches_wall) {
            return wrong("touches no wall");
        }
        if !cut.shares.iter().all(|share| (0.0..=1.0).contains(share)) {
            return wrong("has a share outside 0 to 1");
        }
        before = Some(cell);
    }
    Ok(())
}

/// Fill of a free surface: one entry per cell, 0 to 1, some fluid.
fn surface(setup: &Setup) -> Result<(), StartError> {
    let Some(surface) = &setup.free_surface else { return Ok(()) };
    let expected = setup.cells();
    if surface.fill.len() != expected {
        return Err(StartError::Length { field: "fill", found: surface.fill.len(), expected });
    }
    if let Some(cell) = surface.fill.iter().position(|fill| !(0.0..=1.0).contains(fill)) {
        return Err(StartError::Fill { cell, found: surface.fill[cell] });
    }
    if (0..expected).all(|cell| setup.is_solid(cell) || surface.fill[cell] == 0.0) {
        return Err(StartError::NoFluid);
    }
    Ok(())
}

/// A per-cell array is empty or has one entry per cell, each inside its table.
fn table(
    setup: &Setup,
    field: &'static str,
    entries: &[u8],
    table: &'static str,
    len: usize,
) -> Result<(), StartError> {
    if entries.is_empty() {
        return Ok(());
    }
    let expected = setup.cells();
    if entries.len() != expected {
        return Err(StartError::Length { field, found: entries.len(), expected });
    }
    match entries.iter().position(|&e| usize::from(e) >= len) {
        Some(cell) => Err(StartError::UnknownEntry { table, cell, found: usize::from(entries[cell]), len }),
        None => Ok(()),
    }
}
