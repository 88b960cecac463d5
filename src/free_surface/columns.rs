//! The columns of a box along the force.

/// Steps from a cell of a column to the cells beside it that links lead to, in two coordinates across it.
const BESIDE: [[i64; 2]; 8] = [[-1, -1], [0, -1], [1, -1], [-1, 0], [1, 0], [-1, 1], [0, 1], [1, 1]];

/// Axis of the largest force component; the later of equals.
#[must_use]
pub(crate) fn axis_of(force: &[f64; 3]) -> usize {
    let mut axis = 2;
    for a in [1, 0] {
        if force[a].abs() > force[axis].abs() {
            axis = a;
        }
    }
    axis
}

/// A box of cells seen along the axis of the largest force component.
#[derive(Clone, Copy, Debug)]
pub(super) struct Columns {
    pub extents: [usize; 3],
    /// Per axis: whether its two faces are one.
    pub periodic: [bool; 3],
    pub axis: usize,
    /// Whether the force points towards smaller coordinates.
    pub downward: bool,
}

impl Columns {
    /// Those of a force that is not zero.
    pub fn of(extents: [usize; 3], periodic: [bool; 3], force: &[f64; 3]) -> Self {
        let axis = axis_of(force);
        Self { extents, periodic, axis, downward: force[axis] < 0.0 }
    }

    fn strides(&self) -> [usize; 3] {
        [1, self.extents[0], self.extents[0] * self.extents[1]]
    }

    fn across(&self) -> [usize; 2] {
        [[1, 2], [0, 2], [0, 1]][self.axis]
    }

    /// Runs `work` on every column: its cells from the top down, against the force first.
    pub fn for_each(&self, mut work: impl FnMut(&[usize])) {
        let (strides, [a, b]) = (self.strides(), self.across());
        let n = self.extents[self.axis];
        let mut column = vec![0; n];
        for ib in 0..self.extents[b] {
            for ia in 0..self.extents[a] {
                let start = ia * strides[a] + ib * strides[b];
                for (k, cell) in column.iter_mut().enumerate() {
                    *cell = start + strides[self.axis] * if self.downward { n - 1 - k } else { k };
                }
                work(&column);
            }
        }
    }

    /// The cell so many cells below another of its column.
    pub fn below(&self, cell: usize, cells: usize) -> usize {
        let step = self.strides()[self.axis] * cells;
        if self.downward { cell - step } else { cell + step }
    }

    /// Place of a cell along an axis.
    fn place(&self, cell: usize, axis: usize) -> usize {
        cell / self.strides()[axis] % self.extents[axis]
    }

    /// The cell some steps along an axis; `None` beyond a face that is not periodic.
    fn step(&self, cell: usize, axis: usize, steps: i64) -> Option<usize> {
        let (n, at) = (self.extents[axis] as i64, self.place(cell, axis) as i64);
        let to = at + steps;
        if !self.periodic[axis] && !(0..n).contains(&to) {
            return None;
        }
        Some((cell as i64 + (to.rem_euclid(n) - at) * self.strides()[axis] as i64) as usize)
    }

    /// Cells that links lead to from a cell, in the columns beside its own: in its own row, or in the row `down` cells
    /// below (1 or −1), to which links lead along one of the other axes only.
    pub fn beside(&self, cell: usize, down: i64) -> impl Iterator<Item = usize> {
        let (grid, [a, b]) = (*self, self.across());
        let along = if self.downward { -down } else { down };
        let straight = down != 0;
        let steps = BESIDE.into_iter().filter(move |[x, y]| !(straight && x * y != 0));
        steps.filter_map(move |[x, y]| {
            let cell = grid.step(cell, grid.axis, along)?;
            grid.step(grid.step(cell, a, x)?, b, y)
        })
    }

    /// What is above the first cell of its column: `None` at the end of the box.
    pub fn above(&self, cell: usize) -> Option<usize> {
        self.step(cell, self.axis, if self.downward { 1 } else { -1 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_neighbours_in_and_out_of_a_row() {
        let columns = Columns::of([3, 4, 5], [true, false, false], &[0.0, 0.0, -1.0]);
        let index = |i: usize, j: usize, k: usize| i + 3 * (j + 4 * k);
        let found = |cell, down| {
            let mut cells: Vec<usize> = columns.beside(cell, down).collect();
            cells.sort_unstable();
            cells
        };
        // At the wall y = 0, through the periodic face x = 0.
        let row = [index(1, 0, 2), index(2, 0, 2), index(0, 1, 2), index(1, 1, 2), index(2, 1, 2)];
        assert_eq!(found(index(0, 0, 2), 0), row);
        assert_eq!(found(index(0, 0, 2), 1), [index(1, 0, 1), index(2, 0, 1), index(0, 1, 1)]);
        assert_eq!(found(index(0, 0, 2), -1), [index(1, 0, 3), index(2, 0, 3), index(0, 1, 3)]);
        assert!(found(index(0, 0, 0), 1).is_empty());
        assert_eq!(columns.above(index(0, 0, 4)), None);
        assert_eq!(columns.below(index(1, 1, 4), 3), index(1, 1, 1));
    }
}
