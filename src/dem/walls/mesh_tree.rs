//! A tree of boxes over the triangles of a mesh.

use crate::dem::V3;

/// Triangles per leaf.
const LEAF: usize = 4;

/// One box; a leaf lists triangles, an inner node has its left child next to it.
#[derive(Debug, Clone, PartialEq)]
struct Node {
    low: V3,
    high: V3,
    /// Right child, or first triangle of a leaf.
    next: u32,
    /// Triangles of a leaf; 0 for an inner node.
    count: u32,
}

/// The tree.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    order: Vec<u32>,
}

impl Tree {
    /// Builds the tree by halving along the longest side at the median.
    pub fn new(boxes: &[(V3, V3)]) -> Self {
        let mut tree = Self { nodes: Vec::new(), order: (0..boxes.len() as u32).collect() };
        tree.build(boxes, 0, boxes.len());
        tree
    }

    fn build(&mut self, boxes: &[(V3, V3)], from: usize, to: usize) {
        let (mut low, mut high) = boxes[self.order[from] as usize];
        for &t in &self.order[from..to] {
            low = low.inf(&boxes[t as usize].0);
            high = high.sup(&boxes[t as usize].1);
        }
        let here = self.nodes.len();
        self.nodes.push(Node { low, high, next: from as u32, count: (to - from) as u32 });
        if to - from <= LEAF {
            return;
        }
        let k = (high - low).imax();
        let middle = |t: u32| boxes[t as usize].0[k] + boxes[t as usize].1[k];
        self.order[from..to].sort_by(|&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
        let mid = from + (to - from) / 2;
        self.build(boxes, from, mid);
        self.nodes[here].count = 0;
        self.nodes[here].next = self.nodes.len() as u32;
        self.build(boxes, mid, to);
    }

    /// Box around everything.
    pub(crate) fn bounds(&self) -> (V3, V3) {
        (self.nodes[0].low, self.nodes[0].high)
    }

    /// Triangles of leaves within `reach` of `x`, in the order of the tree.
    pub(crate) fn within(&self, x: &V3, reach: f64, found: &mut Vec<u32>) {
        let mut stack = vec![0u32];
        while let Some(n) = stack.pop() {
            let node = &self.nodes[n as usize];
            let gap = (node.low - x).sup(&(x - node.high)).sup(&V3::zeros());
            if gap.norm_squared() > reach * reach {
                continue;
            }
            if node.count > 0 {
                let first = node.next as usize;
                found.extend_from_slice(&self.order[first..first + node.count as usize]);
            } else {
                stack.push(node.next);
                stack.push(n + 1);
            }
        }
    }
}
