//! Slopes of curves through points, worked out by the compiler, or of points that come at run time.

/// A point of a curve, with what is worked out there.
#[derive(Clone, Copy)]
pub(super) struct Node {
    x: f64,
    pub y: f64,
    /// The first derivative.
    pub slope: f64,
    /// The second derivative.
    pub curvature: f64,
    /// The coefficient of the next curvature in the row of this point, after elimination.
    next: f64,
}

impl Node {
    pub const fn new([x, y]: [f64; 2]) -> Self {
        Self { x, y, slope: 0.0, curvature: 0.0, next: 0.0 }
    }

    /// Points above the numbers of an axis.
    pub const fn along<const N: usize>(axis: &[f64; N]) -> [Self; N] {
        let mut nodes = [Self::new([0.0; 2]); N];
        let mut i = 0;
        while i < N {
            nodes[i].x = axis[i];
            i += 1;
        }
        nodes
    }
}

/// First derivatives of the natural spline at its points, and second ones.
pub(super) const fn slopes_of_spline(nodes: &mut [Node]) {
    curvatures(nodes);
    let mut i = 0;
    while i < nodes.len() {
        // By the piece after the point, of the last one by the piece before it.
        let from = if i + 1 < nodes.len() { i } else { i - 1 };
        let (secant, h) = secant(nodes, from);
        let (a, b) = (nodes[from].curvature, nodes[from + 1].curvature);
        nodes[i].slope = if i == from { secant - h * (2.0 * a + b) / 6.0 } else { secant + h * (a + 2.0 * b) / 6.0 };
        i += 1;
    }
}

/// Slopes of the parabolas through each point and its neighbours; at the ends of those through the last three.
pub(super) const fn slopes_of_parabolas(nodes: &mut [Node]) {
    let count = nodes.len();
    let mut i = 0;
    while i < count {
        let middle = if count == 2 || i == 0 {
            1
        } else if i + 1 == count {
            i - 1
        } else {
            i
        };
        let (before, width) = secant(nodes, middle - 1);
        nodes[i].slope = if count == 2 {
            before
        } else {
            let (after, next) = secant(nodes, middle);
            // The parabola's slope at the middle, and by its curvature at the point.
            let curvature = (after - before) / (width + next);
            before + curvature * width + 2.0 * curvature * (nodes[i].x - nodes[middle].x)
        };
        i += 1;
    }
}

/// The slope of the secant from a point to the next, and how far that is.
const fn secant(nodes: &[Node], from: usize) -> (f64, f64) {
    let width = nodes[from + 1].x - nodes[from].x;
    ((nodes[from + 1].y - nodes[from].y) / width, width)
}

/// Second derivatives of the natural spline at its points: zero at the ends; the tridiagonal system for the others is
/// diagonally dominant, and eliminated as it stands (de Boor, A Practical Guide to Splines, IV).
pub(super) const fn curvatures(nodes: &mut [Node]) {
    // Row i: h₋ m₋ + 2 (h₋ + h₊) m + h₊ m₊ = 6 (s₊ − s₋), where h are widths and s slopes of secants.
    let last = nodes.len() - 1;
    (nodes[0].curvature, nodes[0].next, nodes[last].curvature) = (0.0, 0.0, 0.0);
    let mut i = 1;
    while i < last {
        let ((slope, before), (next_slope, after)) = (secant(nodes, i - 1), secant(nodes, i));
        let pivot = 2.0 * (before + after) - before * nodes[i - 1].next;
        nodes[i].next = after / pivot;
        nodes[i].curvature = (6.0 * (next_slope - slope) - before * nodes[i - 1].curvature) / pivot;
        i += 1;
    }
    while i > 1 {
        i -= 1;
        nodes[i].curvature -= nodes[i].next * nodes[i + 1].curvature;
    }
}
