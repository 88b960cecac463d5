//! The free surface in blocks.

use super::kernel::Outcome;
use super::layout::Layout;
use super::run::FastRun;
use crate::free_surface::Kind;
use crate::lattice::Q;
use crate::lattice::moments::Moments;
use crate::solver::fingerprint::Hasher;
use crate::solver::physics::Physics;
use crate::solver::run::{Fields, Ledger, Load, StartError, Stopped};

/// An interface cell.
#[derive(Clone, Debug)]
pub struct InterfaceCell {
    /// Place in the block.
    pub local: u16,
    /// What it touches.
    pub touches: u8,
    /// Populations before collision.
    pub f: [f64; Q],
    /// u of the last collision.
    pub velocity: [f64; 3],
    /// m.
    pub mass: f64,
}

/// What the passes read of the surface.
#[derive(Clone, Copy)]
pub struct SurfaceView<'a> {
    /// Fluid and interface lanes by block and pack.
    pub masks: &'a [Vec<(u16, u16)>],
    /// φ.
    pub fill: &'a [Vec<f64>],
}

impl SurfaceView<'_> {
    /// F.
    pub fn force_of(&self, number: usize, local: usize, force: &[f64; 3], _layout: &Layout) -> [f64; 3] {
        force.map(|f| self.fill[number][local] * f)
    }
}

pub struct Surface {
    pub interface: Vec<Vec<InterfaceCell>>,
    pub kinds: Vec<Vec<Kind>>,
    pub loads: Vec<Load>,
}
impl Surface {
    pub fn view(&self) -> SurfaceView<'_> {
        unreachable!()
    }
    pub fn force_at<P>(&self, _r: &FastRun<P>, _n: usize, _l: usize, _f: &[f64; 3]) -> Option<[f64; 3]> {
        None
    }
    pub fn interface_cell(&self, _n: usize, _l: usize) -> Option<&InterfaceCell> {
        None
    }
    pub fn start_fields<P>(&self, _r: &FastRun<P>, _f: &mut Fields) {}
    pub fn fill_of(&self, _n: usize, _l: usize, _r: f64) -> f64 {
        0.0
    }
    pub fn mass_of(&self, _n: usize, _l: usize, _m: &Moments<f64>) -> (f64, f64) {
        (0.0, 0.0)
    }
    pub fn hash_cell(&self, _h: &mut Hasher, _c: usize, _n: usize, _l: usize) {}
    pub fn fluid_cells(&self) -> u64 {
        0
    }
    pub fn bytes(&self) -> u64 {
        0
    }
}
impl<P: Physics> FastRun<P> {
    pub fn start_surface(&mut self) -> Result<(), StartError> {
        Ok(())
    }
    pub fn close_last_step(&mut self, _o: &[Outcome]) -> Result<(), Stopped> {
        Ok(())
    }
    pub fn surface_pass(&mut self, _f: &[f64; 3]) {}
    pub fn settle(&mut self) -> Result<(), Stopped> {
        Ok(())
    }
    pub fn make_ledger(&self) -> Option<Ledger> {
        None
    }
    pub fn hash_rest(&self, _h: &mut Hasher) {}
}
