//! Rotations: the matrix of a unit quaternion's components, and R as a function of each rotation chart's coordinates.

use crate::algebra::{Expr, Graph};
use crate::terms::RotationChart;

use crate::mechanics::kinematics::vector::{Axes, Triple, cross, cross_matrix, dot};
use crate::mechanics::name::Name;

/// Names of a rotation chart's coordinates.
pub fn coordinate_names(chart: RotationChart) -> Vec<Name> {
    let (phi, theta, psi) = (Name::new("φ", "\\varphi"), Name::new("θ", "\\vartheta"), Name::new("ψ", "\\psi"));
    match chart {
        // Precession, nutation, spin for the proper Euler angles; roll, pitch, yaw about x, y, z wherever they stand.
        RotationChart::Euler(axes) if axes[0] == axes[2] => vec![phi, theta, psi],
        RotationChart::Euler(axes) => axes
            .iter()
            .map(|axis| match axis {
                0 => phi.clone(),
                1 => theta.clone(),
                _ => psi.clone(),
            })
            .collect(),
        RotationChart::Rodrigues => (0..3).map(|i| Name::new("g", "g").index(i)).collect(),
        RotationChart::ModifiedRodrigues => (0..3).map(|i| Name::new("σ", "\\sigma").index(i)).collect(),
        RotationChart::Angle => vec![theta],
    }
}

/// R as a function of the chart's coordinates.
pub fn rotation_of<'g>(graph: &'g Graph, chart: RotationChart, q: &[Expr<'g>]) -> [Triple<'g>; 3] {
    match chart {
        RotationChart::Euler(axes) => {
            let turns = [0, 1, 2].map(|k| about_axis(graph, usize::from(axes[k]), q[k]));
            product(&product(&turns[0], &turns[1]), &turns[2])
        }
        RotationChart::Angle => about_axis(graph, 2, q[0]),
        // Quaternion (1, g)/√(1 + g²) with g = tan(θ/2) n.
        RotationChart::Rodrigues => {
            let g = [q[0], q[1], q[2]];
            let norm = (graph.one() + dot(&g, &g)).group();
            let half = cross_plus_square(graph.one(), &g);
            std::array::from_fn(|i| {
                std::array::from_fn(|j| identity(graph, i, j) + (half[i][j] + half[i][j]) * norm.recip())
            })
        }
        // Quaternion (1 − σ², 2σ)/(1 + σ²) with σ = tan(θ/4) n.
        RotationChart::ModifiedRodrigues => {
            let s = [q[0], q[1], q[2]];
            let square = dot(&s, &s);
            let norm = (graph.one() + square).group();
            let two = graph.integer(2);
            let half = cross_plus_square((graph.one() - square).group(), &s.map(|e| two * e));
            std::array::from_fn(|i| {
                std::array::from_fn(|j| identity(graph, i, j) + (half[i][j] + half[i][j]) * norm.powi(-2))
            })
        }
    }
}

/// R of a unit quaternion (x, y, z, w). Doubled components are quantities of their own: nine products serve all
/// entries.
pub fn rotation_of_quaternion<'g>(graph: &'g Graph, [x, y, z, w]: [Expr<'g>; 4]) -> [Triple<'g>; 3] {
    let half = cross_plus_square(w, &[x, y, z]);
    std::array::from_fn(|i| std::array::from_fn(|j| identity(graph, i, j) + half[i][j].scale(2.into())))
}

/// Rates of a unit quaternion (x, y, z, w) by an angular velocity: ½ q ω with ω in body axes, ½ ω q in space axes.
pub fn quaternion_rate<'g>([x, y, z, w]: [Expr<'g>; 4], omega: &Triple<'g>, axes: Axes) -> [Expr<'g>; 4] {
    let v = [x, y, z];
    let turned = match axes {
        Axes::Body => cross(&v, omega),
        Axes::Space => cross(omega, &v),
    };
    let [a, b, c] = std::array::from_fn(|k| (w * omega[k] + turned[k]).half());
    [a, b, c, -dot(&v, omega).half()]
}

/// `w [v]× + [v]×²`: half of what a quaternion (v, w) adds to the identity.
fn cross_plus_square<'g>(w: Expr<'g>, v: &Triple<'g>) -> [Triple<'g>; 3] {
    let turn = cross_matrix(v);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let square: Expr<'g> = (0..3).map(|k| turn[i][k] * turn[k][j]).sum();
            w * turn[i][j] + square
        })
    })
}

fn identity(graph: &Graph, i: usize, j: usize) -> Expr<'_> {
    if i == j { graph.one() } else { graph.zero() }
}

/// Turn by an angle about an axis of the frame: `1 + sin α [k]× + (1 − cos α) [k]×²`.
pub fn about_axis<'g>(graph: &'g Graph, axis: usize, angle: Expr<'g>) -> [Triple<'g>; 3] {
    let unit: Triple<'g> = std::array::from_fn(|i| identity(graph, i, axis));
    let turn = cross_matrix(&unit);
    let (sine, rest) = (angle.sin(), graph.one() - angle.cos());
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let square: Expr<'g> = (0..3).map(|k| turn[i][k] * turn[k][j]).sum();
            identity(graph, i, j) + sine * turn[i][j] + rest * square
        })
    })
}

/// Poisson's rates of the entries of R, by their keys: Ṙ = R [ω]× with ω in body axes.
pub fn poisson<'g>(rotation: &[Triple<'g>; 3], omega: &Triple<'g>) -> impl Iterator<Item = (u32, Expr<'g>)> + use<'g> {
    let (rotation, turn) = (*rotation, cross_matrix(omega));
    let rate = move |n: usize| (0..3).map(|k| rotation[n / 3][k] * turn[k][n % 3]).sum();
    (0..9).map(move |n| (rotation[n / 3][n % 3].key(), rate(n)))
}

pub fn product<'g>(a: &[Triple<'g>; 3], b: &[Triple<'g>; 3]) -> [Triple<'g>; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}
