//! The derived equations in text, for review against the paper's displayed equations: every chart and motion, each with
//! four bodies.

use crate::algebra::{Graph, Notation};
use crate::terms::{Chart, Motion, RotationChart, Shape};

use crate::mechanics::matter::body::BodyShape;
use crate::mechanics::print::readings::Readings;
use crate::mechanics::tests::ChartedSystem;

const PRINCIPAL: BodyShape = BodyShape {
    inertia: Shape::Vector3,
    central: false,
    center_of_mass: false,
    added_mass: None,
    gravity: None,
    displaced_mass: false,
    center_of_buoyancy: false,
};

fn bodies() -> [(&'static str, BodyShape); 4] {
    [
        ("principal axes at G", PRINCIPAL),
        ("full inertia, G off O", BodyShape { inertia: Shape::Matrix3, center_of_mass: true, ..PRINCIPAL }),
        ("principal axes at G, diagonal added mass", BodyShape { added_mass: Some(Shape::Vector6), ..PRINCIPAL }),
        ("G off O, weight", BodyShape { center_of_mass: true, gravity: Some(Shape::Scalar), ..PRINCIPAL }),
    ]
}

fn equations(motion: Motion, chart: Chart, notation: Notation) -> String {
    let mut out = String::new();
    for (title, shape) in bodies() {
        let graph = Graph::new();
        out.push_str(&format!("=== {title}\n"));
        for (title, lines) in ChartedSystem::new(&graph, motion, chart, shape)
            .system
            .equations(&Readings::default(), None)
            .print(notation)
        {
            out.push_str(&format!("\n{title}\n"));
            lines.iter().for_each(|line| out.push_str(&format!("  {line}\n")));
        }
        out.push('\n');
    }
    out
}

const ZYX: Chart = Chart::Jet(RotationChart::Euler([2, 1, 0]));
const ZXZ: Chart = Chart::Jet(RotationChart::Euler([2, 0, 2]));
const RODRIGUES: Chart = Chart::Jet(RotationChart::Rodrigues);
const ANGLE: Chart = Chart::Jet(RotationChart::Angle);

macro_rules! snapshots {
    ($($name:ident: $motion:ident, $chart:expr;)*) => {$(
        #[test]
        fn $name() {
            insta::assert_snapshot!(equations(Motion::$motion, $chart, Notation::Text));
        }
    )*};
}

snapshots! {
    free_left_invariant: Free, Chart::LeftInvariant;
    free_right_invariant: Free, Chart::RightInvariant;
    free_hybrid: Free, Chart::Hybrid;
    free_jet_euler_zyx: Free, ZYX;
    free_jet_euler_zxz: Free, ZXZ;
    free_jet_rodrigues: Free, RODRIGUES;
    fixed_point_left_invariant: FixedPoint, Chart::LeftInvariant;
    fixed_point_right_invariant: FixedPoint, Chart::RightInvariant;
    fixed_point_hybrid: FixedPoint, Chart::Hybrid;
    fixed_point_jet_euler_zyx: FixedPoint, ZYX;
    fixed_point_jet_euler_zxz: FixedPoint, ZXZ;
    planar_left_invariant: Planar, Chart::LeftInvariant;
    planar_right_invariant: Planar, Chart::RightInvariant;
    planar_hybrid: Planar, Chart::Hybrid;
    planar_jet: Planar, ANGLE;
}

#[test]
fn latex_of_kirchhoffs_equations() {
    insta::assert_snapshot!(equations(Motion::Free, Chart::LeftInvariant, Notation::Latex));
}
