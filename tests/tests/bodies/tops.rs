//! Tops: heavy, Kovalevskaya's, Goryachev and Chaplygin's; each as a rotation, in the observer's axes, in Euler angles,
//! as a free body that constraints hold at O, and in the charts of one body.

use gauss_runtime::prelude::*;
use gauss_tests::laws::{Flow, System, Time, constrained_laws, corresponds, laws, least, position_rates};
use gauss_tests::trajectory::{Run, number, numbers, reference, rotation, rows, triple};
use proptest::prelude::*;

/// A top's parameters.
#[derive(Clone, Copy, Debug)]
struct Top {
    mass: f64,
    center: Vector3<f64>,
    inertia: Matrix3<f64>,
    g: f64,
}

macro_rules! top {
    ($name:ident $kernel:ident [$($clause:tt)+]) => {
        #[derive(GaussDynamics)]
        #[gauss($($clause)+)]
        struct $name {
            #[gauss(mass)]
            mass: f64,
            #[gauss(center_of_mass)]
            center: Vector3<f64>,
            #[gauss(inertia)]
            inertia: Matrix3<f64>,
            #[gauss(gravity)]
            g: f64,
        }

        impl TryFrom<Top> for $kernel {
            type Error = ParameterError;

            fn try_from(Top { mass, center, inertia, g }: Top) -> Result<Self, ParameterError> {
                $name { mass, center, inertia, g }.kernel()
            }
        }
    };
}

top!(ByRotation ByRotationKernel [coordinates(attitude: Rotation), body(rotation = attitude)]);
top!(FromSpace FromSpaceKernel [
    coordinates(attitude: Rotation),
    speeds(w: Vector3),
    kinematics(attitude = inverse(attitude) * w),
    body(rotation = attitude)
]);
top!(ByAngles ByAnglesKernel [
    coordinates(phi, theta, psi),
    body(rotation = rotation_z(phi) * rotation_x(theta) * rotation_z(psi))
]);
top!(Held HeldKernel [
    coordinates(pose: Pose),
    body(position = pose.position, rotation = pose.rotation),
    constraint(position = pose.position)
]);
top!(Left LeftKernel [chart = left_invariant, motion = fixed_point]);
top!(Right RightKernel [chart = right_invariant, motion = fixed_point]);
top!(Jet JetKernel [chart = jet(euler_zxz), motion = fixed_point]);

fn top(name: &str) -> Top {
    let p = &reference(name)["parameters"];
    Top {
        mass: number(&p["mass"]),
        center: triple(&p["centre_of_mass_body_from_O"]),
        inertia: Matrix3::from_row_slice(&numbers(&p["inertia_about_O"])),
        g: number(&p["gravity"]),
    }
}

fn kernel<K: TryFrom<Top, Error = ParameterError>>(top: Top) -> K {
    K::try_from(top).expect("a body has these moments")
}

type Rotating = (UnitQuaternion<f64>, Vector3<f64>);
type Turned = (SVector<f64, 3>, SVector<f64, 3>);

fn to_space(r: &UnitQuaternion<f64>, w: &Vector3<f64>) -> Rotating {
    (*r, r * w)
}

fn to_body(r: &UnitQuaternion<f64>, w: &Vector3<f64>) -> Rotating {
    (*r, r.inverse() * w)
}

/// R_z(φ) R_x(θ) R_z(ψ): angles and their rates.
fn to_angles(r: &UnitQuaternion<f64>, w: &Vector3<f64>) -> Turned {
    let m = r.to_rotation_matrix().into_inner();
    let sine = m[(2, 0)].hypot(m[(2, 1)]);
    let q = SVector::from([m[(0, 2)].atan2(-m[(1, 2)]), sine.atan2(m[(2, 2)]), m[(2, 0)].atan2(m[(2, 1)])]);
    let (s, c) = q[2].sin_cos();
    let phi = (w.x * s + w.y * c) / sine;
    (q, SVector::from([phi, w.x * c - w.y * s, w.z - phi * m[(2, 2)]]))
}

fn from_angles(q: &SVector<f64, 3>, z: &SVector<f64, 3>) -> Rotating {
    let axes = [Vector3::z_axis(), Vector3::x_axis(), Vector3::z_axis()];
    let turns: [_; 3] = std::array::from_fn(|k| UnitQuaternion::from_axis_angle(&axes[k], q[k]));
    let ((s, c), (st, ct)) = (q[2].sin_cos(), q[1].sin_cos());
    let w = Vector3::new(z[0] * st * s + z[1] * c, z[0] * st * c - z[1] * s, z[0] * ct + z[2]);
    (turns[0] * turns[1] * turns[2], w)
}

fn to_held(r: &UnitQuaternion<f64>, w: &Vector3<f64>) -> (Isometry3<f64>, Vector6<f64>) {
    (Isometry3 { rotation: *r, translation: Translation3::identity() }, Vector6::new(0.0, 0.0, 0.0, w.x, w.y, w.z))
}

fn from_held(q: &Isometry3<f64>, z: &Vector6<f64>) -> Rotating {
    (q.rotation, Vector3::new(z[3], z[4], z[5]))
}

/// How much Euler angles magnify errors on the way: rates by 1/sin θ, and what their own errors do again.
fn stretch_of_angles(kernel: &ByRotationKernel, start: Rotating, duration: f64) -> f64 {
    let mut least = 1.0_f64;
    let see = |sample: &Sample<ByRotationKernel>| {
        let m = sample.q.to_rotation_matrix().into_inner();
        least = least.min(m[(2, 0)].hypot(m[(2, 1)]));
    };
    Simulation::new(kernel).fixed_step(1e-3).observe(see).run_to_end(start.0, start.1, 0.0..duration).unwrap();
    least.powi(-2)
}

/// Follows a top over its reference in all variables.
fn follow(name: &str) {
    let scene = reference(name);
    let top = top(name);
    let r = rotation(&scene["initial"]["R"]);
    let w = triple(&scene["initial"]["body_omega"]);
    let see = |(r, w): Rotating| vec![("R", rows(&r)), ("body_omega", w.as_slice().to_vec())];

    let system = kernel::<ByRotationKernel>(top);
    Run { name, system: &system, start: (r, w) }.agrees(1.0, |_, q, z| see((*q, *z)));
    let stretch = stretch_of_angles(&system, (r, w), number(&scene["T"]));
    let system = kernel::<FromSpaceKernel>(top);
    Run { name, system: &system, start: to_space(&r, &w) }.agrees(1.0, |_, q, z| see(to_body(q, z)));
    let system = kernel::<ByAnglesKernel>(top);
    Run { name, system: &system, start: to_angles(&r, &w) }.agrees(stretch, |_, q, z| see(from_angles(q, z)));
    // Kovalevskaya's has no moments about G that a body could have, and only turns about O.
    if name != "kovalevskaya" {
        let system = kernel::<HeldKernel>(top);
        Run { name, system: &system, start: to_held(&r, &w) }.agrees(1.0, |_, q, z| see(from_held(q, z)));
    }
}

#[test]
fn heavy_top_as_in_the_reference() {
    follow("heavy_asym_top");
}

#[test]
fn lagrange_top_as_in_the_reference() {
    follow("lagrange_top");
}

#[test]
fn kovalevskaya_top_as_in_the_reference() {
    follow("kovalevskaya");
}

#[test]
fn goryachev_chaplygin_top_as_in_the_reference() {
    follow("goryachev_chaplygin");
}

/// Where O is not fixed by the coordinates the moments about G must be those of a body.
#[test]
fn kovalevskaya_top_is_no_free_body() {
    let error = HeldKernel::try_from(top("kovalevskaya")).unwrap_err().to_string();
    assert!(error.contains("inertia"), "{error}");
}

/// The upward vertical in body axes, and ν = m g ℓ/I₃.
fn upward(top: &Top, r: &UnitQuaternion<f64>) -> (Vector3<f64>, f64) {
    (r.inverse() * Vector3::z(), top.mass * top.g * top.center.x / top.inertia[(2, 2)])
}

fn momentum_about_vertical(top: &Top, r: &UnitQuaternion<f64>, w: &Vector3<f64>) -> f64 {
    (top.inertia * w).dot(&upward(top, r).0)
}

/// S. V. Kovalevskaya (1889): I = (2, 2, 1) I₃, G on e₁.
fn kovalevskaya(top: &Top, r: &UnitQuaternion<f64>, w: &Vector3<f64>) -> f64 {
    let (up, nu) = upward(top, r);
    (w.x * w.x - w.y * w.y - nu * up.x).powi(2) + (2.0 * w.x * w.y - nu * up.y).powi(2)
}

/// D. N. Goryachev (1900), S. A. Chaplygin (1901): I = (4, 4, 1) I₃, G on e₁; constant while Γ_O·k₃ = 0.
fn goryachev_chaplygin(top: &Top, r: &UnitQuaternion<f64>, w: &Vector3<f64>) -> f64 {
    let (up, nu) = upward(top, r);
    w.z * (w.x * w.x + w.y * w.y) - nu * w.x * up.z
}

type Integral = fn(&Top, &UnitQuaternion<f64>, &Vector3<f64>) -> f64;

const INTEGRALS: [(&str, &str, Integral); 4] = [
    ("kovalevskaya", "L_z", momentum_about_vertical),
    ("kovalevskaya", "Kovalevskaya", kovalevskaya),
    ("goryachev_chaplygin", "L_z", momentum_about_vertical),
    ("goryachev_chaplygin", "Goryachev_Chaplygin", goryachev_chaplygin),
];

/// Twenty units of time with a tolerance of 1e-11 a step: integrals stay to 1e-10 of terms of order ten.
#[test]
fn integrals_are_kept_in_long_runs() {
    for (name, integral, value) in INTEGRALS {
        let scene = reference(name);
        let top = top(name);
        let start = (rotation(&scene["initial"]["R"]), triple(&scene["initial"]["body_omega"]));
        let expected = number(&scene["conserved"][integral]["value_t0"]);
        let mut worst = 0.0_f64;
        let mut see =
            |r: &UnitQuaternion<f64>, w: &Vector3<f64>| worst = worst.max((value(&top, r, w) - expected).abs());
        Simulation::new(&kernel::<ByRotationKernel>(top))
            .adaptive(1e-11, 1e-11)
            .observe(|sample| see(&sample.q, &sample.z))
            .run_to_end(start.0, start.1, 0.0..20.0)
            .unwrap();
        let space = to_space(&start.0, &start.1);
        Simulation::new(&kernel::<FromSpaceKernel>(top))
            .momentum_form()
            .adaptive(1e-11, 1e-11)
            .observe(|sample| see(&sample.q, &to_body(&sample.q, &sample.z).1))
            .run_to_end(space.0, space.1, 0.0..20.0)
            .unwrap();
        assert!(worst <= 1e-9, "{name} {integral}: {worst:e}");
    }
}

/// The force at O on a top that constraints hold there: m a_G + m g k₃.
#[test]
fn the_multipliers_of_a_held_top_are_the_force_at_its_point() {
    for (name, at) in [("heavy_asym_top", [0.4, -1.1, 0.8]), ("goryachev_chaplygin", [2.0, 0.3, -0.5])] {
        let top = top(name);
        let kernel = kernel::<HeldKernel>(top);
        let (r, w) = (UnitQuaternion::from_scaled_axis(Vector3::from(at)), Vector3::new(1.2, -2.0, 0.7));
        let (q, z) = to_held(&r, &w);
        let turning = from_held(&q, &kernel.acceleration(0.0, &q, &z, &())).1;
        let acceleration = turning.cross(&top.center) + w.cross(&w.cross(&top.center));
        let expected = (r * acceleration + Vector3::z() * top.g) * top.mass;
        let found = kernel.multipliers(0.0, &q, &z, &());
        // Some hundred roundings, and moments with ratios below ten.
        assert!((found - expected).amax() <= 1e4 * f64::EPSILON * expected.amax(), "{found} {expected}");
    }
}

/// The same top in every other description.
fn in_every_description(top: Top, r: UnitQuaternion<f64>, w: Vector3<f64>) {
    let system = kernel::<ByRotationKernel>(top);
    laws(&system, 0.0, &r, &w, Time::Absent);
    least(&system, 0.0, &r, &w);
    let at = (&r, &w);
    corresponds(&system, &kernel::<FromSpaceKernel>(top), 0.0, at, |_, r, w| to_space(r, w));
    corresponds(&system, &kernel::<LeftKernel>(top), 0.0, at, |_, r, w| (*r, *w));
    corresponds(&system, &kernel::<RightKernel>(top), 0.0, at, |_, r, w| to_space(r, w));

    let space = kernel::<FromSpaceKernel>(top);
    let (q, z) = to_space(&r, &w);
    laws(&space, 0.0, &q, &z, Time::Absent);
    least(&space, 0.0, &q, &z);
    corresponds(&space, &system, 0.0, (&q, &z), |_, q, z| to_body(q, z));
}

/// The same top held by constraints.
fn held(top: Top, r: UnitQuaternion<f64>, w: Vector3<f64>, off: [f64; 12]) {
    let held = kernel::<HeldKernel>(top);
    corresponds(&kernel::<ByRotationKernel>(top), &held, 0.0, (&r, &w), |_, r, w| to_held(r, w));
    let (q, z) = to_held(&r, &w);
    let near = (q.retract(&Vector6::from_column_slice(&off[..6])), z + Vector6::from_column_slice(&off[6..]));
    position_rates(&held, 0.0, &near.0, &near.1);
    let (q, z) = held.project(0.0, &near.0, &near.1).unwrap();
    laws(&held, 0.0, &q, &z, Time::Absent);
    constrained_laws(&held, 0.0, &q, &z);
}

/// Euler angles and their rates, with the middle angle a third of a radian from where they fail.
fn in_angles(top: Top, q: SVector<f64, 3>, z: SVector<f64, 3>) {
    let angles = kernel::<ByAnglesKernel>(top);
    laws(&angles, 0.0, &q, &z, Time::Absent);
    least(&angles, 0.0, &q, &z);
    corresponds(&angles, &kernel::<ByRotationKernel>(top), 0.0, (&q, &z), |_, q, z| from_angles(q, z));
    corresponds(&angles, &kernel::<JetKernel>(top), 0.0, (&q, &z), |_, q, z| (*q, *z));
}

/// The rate of an integral along the flow.
fn rate_of<S: System<Configuration = UnitQuaternion<f64>, Speeds = Vector3<f64>>>(
    system: &S,
    (r, w): (&UnitQuaternion<f64>, &Vector3<f64>),
    value: impl Fn(&UnitQuaternion<f64>, &Vector3<f64>) -> f64,
) -> f64 {
    Flow::new(system, 0.0, r, w).rate(|_, r, w| vec![value(r, w)])[0]
}

prop_compose! {
    fn any_rotation()(turn in prop::array::uniform3(-1.7..1.7_f64)) -> UnitQuaternion<f64> {
        UnitQuaternion::from_scaled_axis(Vector3::from(turn))
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn tops_at_random(
        r in any_rotation(), w in prop::array::uniform3(-3.0..3.0_f64), off in prop::array::uniform12(-0.1..0.1_f64)
    ) {
        for name in ["heavy_asym_top", "kovalevskaya", "goryachev_chaplygin"] {
            in_every_description(top(name), r, Vector3::from(w));
        }
        for name in ["heavy_asym_top", "goryachev_chaplygin"] {
            held(top(name), r, Vector3::from(w), off);
        }
    }

    #[test]
    fn tops_in_angles_at_random(
        phi in -3.0..3.0_f64, theta in 0.6..2.5_f64, psi in -3.0..3.0_f64, z in prop::array::uniform3(-3.0..3.0_f64)
    ) {
        for name in ["heavy_asym_top", "kovalevskaya", "goryachev_chaplygin"] {
            in_angles(top(name), SVector::from([phi, theta, psi]), SVector::from(z));
        }
    }

    /// The third integrals, at every state (for the second: at every state without momentum about the vertical).
    #[test]
    fn integrals_are_constant_along_the_flow(r in any_rotation(), w in prop::array::uniform3(-3.0..3.0_f64)) {
        let w = Vector3::from(w);
        let (first, second) = (top("kovalevskaya"), top("goryachev_chaplygin"));
        let rate = rate_of(&kernel::<ByRotationKernel>(first), (&r, &w), |r, w| kovalevskaya(&first, r, w));
        // Terms of the fourth power of ω, and ten thousand roundings of them over the step of the difference.
        let size = (w.norm() + 5.0).powi(4);
        prop_assert!(rate.abs() <= 1e-10 * size, "{rate:e}");
        // Without the part of Γ_O along the vertical.
        let up = upward(&second, &r).0;
        let w = w - up * ((second.inertia * w).dot(&up) / (second.inertia * up).dot(&up));
        let rate = rate_of(&kernel::<ByRotationKernel>(second), (&r, &w), |r, w| goryachev_chaplygin(&second, r, w));
        let size = (w.norm() + 5.0).powi(3);
        prop_assert!(rate.abs() <= 1e-10 * size, "{rate:e}");
    }
}

/// A top that sleeps next to the vertical, where the Euler angles have no value: errors of a step are those of the
/// speeds, whichever variables are integrated. The rates of φ and ψ are momenta over sin²θ.
#[test]
fn a_sleeping_top_by_its_momenta() {
    let top = Top {
        mass: 1.0,
        center: Vector3::new(0.0, 0.0, 0.4),
        inertia: Matrix3::from_diagonal(&Vector3::new(0.5, 0.5, 0.2)),
        g: 9.81,
    };
    let (jet, space): (JetKernel, LeftKernel) = (kernel(top), kernel(top));
    for tilt in [0.3, 1e-2, 1e-3] {
        // Upright to a tilt, spinning fast: ω along the axis of the top.
        let (q, z) = (SVector::from([0.4, tilt, -0.7]), SVector::from([0.0, 0.3 * tilt, 30.0]));
        let attitude = |q: &SVector<f64, 3>| {
            UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q[0])
                * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), q[1])
                * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), q[2])
        };
        let spin = |q: &SVector<f64, 3>, z: &SVector<f64, 3>| {
            let ((s, c), (st, ct)) = (q[2].sin_cos(), q[1].sin_cos());
            Vector3::new(z[0] * st * s + z[1] * c, z[0] * st * c - z[1] * s, z[0] * ct + z[2])
        };
        let start = (attitude(&q), spin(&q, &z));
        let exact = Simulation::new(&space).adaptive(1e-14, 1e-14).run_to_end(start.0, start.1, 0.0..5.0).unwrap();
        let run = Simulation::new(&jet).adaptive(1e-12, 1e-13);
        let far =
            |end: &Sample<JetKernel>| (attitude(&end.q).angle_to(&exact.q), (spin(&end.q, &end.z) - exact.z).norm());
        for end in [run.run_to_end(q, z, 0.0..5.0).unwrap(), run.momentum_form().run_to_end(q, z, 0.0..5.0).unwrap()] {
            let (turn, spin) = far(&end);
            // A tolerance for each of some hundred steps, of rates up to 30.
            assert!(turn <= 1e-10 && spin <= 3e-9, "{tilt:e}: {turn:e} {spin:e}");
        }
    }
}

/// A body whose O is far from it: its momenta are of its motion about O, and small parts of them are much of its spin.
#[derive(GaussDynamics)]
#[gauss(chart = hybrid)]
struct Far {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia_about_center_of_mass)]
    inertia: Vector3<f64>,
}

/// The number of steps is another question: ∂ṗ/∂p is of the size m |c|² ω/I, and with O far away the momentum form is
/// stiff.
#[test]
fn a_body_far_from_its_origin_by_its_momenta() {
    for size in [0.0, 0.1, 1.0, 10.0] {
        let center = Vector3::new(3.0, -2.0, 1.0) * size;
        let kernel = Far { mass: 2.0, center, inertia: Vector3::new(0.3, 0.5, 0.7) }.kernel().unwrap();
        let q = Isometry3::rotation(Vector3::new(0.2, -0.3, 0.5));
        let z = SVector::from([0.3, 0.1, -0.2, 0.7, -1.1, 0.9]);
        let exact = Simulation::new(&kernel).adaptive(1e-13, 1e-13).run_to_end(q, z, 0.0..10.0).unwrap();
        for tolerance in [1e-6, 1e-9] {
            let run = Simulation::new(&kernel).adaptive(tolerance, tolerance).momentum_form();
            let end = run.run_to_end(q, z, 0.0..10.0).unwrap();
            let error = (end.z - exact.z).amax();
            // A tolerance for each of some ten turns.
            assert!(error <= 10.0 * tolerance * (1.0 + exact.z.amax()), "{size} {tolerance:e}: {error:e}");
        }
    }
}
