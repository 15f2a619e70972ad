//! A body of four particles that move by two modes, by integrals and one by one: displacements are linear in η, so that
//! no term of the energy is beyond the second order and both are the same system.

use gauss_runtime::prelude::*;

use crate::common::Bounded;
use crate::common::agreement::equal;
use crate::common::groups::{Random, random_configuration};
use crate::common::kernels::same;

macro_rules! pair {
    ($test:ident: $modal:ident $beside:ident, $origin:expr, [$($scene:tt)+] [$($modes:tt)+] [$($particles:tt)+]) => {
        #[derive(GaussDynamics)]
        #[gauss($($scene)+, $($modes)+)]
        struct $modal<T> {
            k: T,
            #[gauss(gravity)]
            g: Vector3<T>,
        }

        #[derive(GaussDynamics)]
        #[gauss($($scene)+, $($particles)+)]
        struct $beside<T> {
            k: T,
            #[gauss(gravity)]
            g: Vector3<T>,
        }

        #[test]
        fn $test() {
            let [k, a, b, c] = [6.0, 1.5, -2.0, -9.81].map(Bounded::from_f64);
            let g = Vector3::new(a, b, c);
            same(&$origin, &$modal { k, g }.kernel().unwrap(), &$beside { k, g }.kernel().unwrap());
        }
    };
}

// A panel on a hinge of a free craft.
pair!(on_a_free_craft: Modal Particles, (Isometry3::<f64>::identity(), SVector::from([0.4, 0.2, -0.3])), [
    coordinates(base: Pose, theta, a, b),
    body(hull, pose = base, mass = 20, center_of_mass = [0.1, 0, 0.2], inertia = [5, 6, 7])
] [
    body(panel, parent = hull, position = [0.5, 0.1, 0], rotation = rotation_z(theta),
        mass = 8, center_of_mass = [1.125, -0.125, 1.125], inertia = [24, 0, -8, 30, 7, 20]),
    modes(panel, coordinates = [a, b],
        translation = [[2, 4, 4], [4, 2, 2]],
        rotation = [[-9, -6, 2], [-1, 2, 3]],
        mass = [[10.5, 3], [3, 7.5]],
        stiffness = [[4, 1], [1, k]],
        damping = [[0.2, 0.1], [0.1, 0.3]],
        inertia = [[-2, 10, -4, -6, -8, -7], [-4, 14, 6, -3, -6, -5]],
        gyroscopic = [[[0, 0, 0], [3, -1.5, 3]], [[-3, 1.5, -3], [0, 0, 0]]],
        second_inertia = [[[18, 13, 11, 0, 0, -4], [4, 2, 6, -1, -4.5, -3]],
                          [[4, 2, 6, -1, -4.5, -3], [9, 9, 12, -2, -2, 2]]])
] [
    frame(panel, parent = hull, position = [0.5, 0.1, 0], rotation = rotation_z(theta)),
    particle(parent = panel, mass = 1, position = [1, b, a]),
    particle(parent = panel, mass = 2, position = [2 + 0.5 * a + b, 1, a + 0.5 * b]),
    particle(parent = panel, mass = 1, position = [a, 1 - b, 1 - a + b]),
    particle(parent = panel, mass = 4, position = [1 + 0.5 * b, -1 + a + 0.5 * b, 2 + 0.5 * a]),
    potential = 2 * a * a + a * b + 0.5 * k * b * b,
    drive(a = -0.2 * rate(a) - 0.1 * rate(b), b = -0.1 * rate(a) - 0.3 * rate(b))
]);

// The rates of modes and joints are mixed in the speeds, and the hinge is moved in time.
pair!(by_quasi_velocities: ModalMixed ParticlesMixed, SVector::from([0.4, 0.2, -0.3]), [
    coordinates(theta, a, b),
    speeds(v, p, r),
    kinematics(theta = v + a * p, a = p * cos(theta) - 2 * r, b = r + 0.3 * v)
] [
    body(panel, position = [0.3 * t, 0.1, t * t], rotation = rotation_y(theta),
        mass = 8, center_of_mass = [1.125, -0.125, 1.125], inertia = [24, 0, -8, 30, 7, 20]),
    modes(panel, coordinates = [a, b],
        translation = [[2, 4, 4], [4, 2, 2]],
        rotation = [[-9, -6, 2], [-1, 2, 3]],
        mass = [[10.5, 3], [3, 7.5]],
        stiffness = [4, k],
        inertia = [[-2, 10, -4, -6, -8, -7], [-4, 14, 6, -3, -6, -5]],
        gyroscopic = [[[0, 0, 0], [3, -1.5, 3]], [[-3, 1.5, -3], [0, 0, 0]]],
        second_inertia = [[[18, 13, 11, 0, 0, -4], [4, 2, 6, -1, -4.5, -3]],
                          [[4, 2, 6, -1, -4.5, -3], [9, 9, 12, -2, -2, 2]]])
] [
    frame(panel, position = [0.3 * t, 0.1, t * t], rotation = rotation_y(theta)),
    particle(parent = panel, mass = 1, position = [1, b, a]),
    particle(parent = panel, mass = 2, position = [2 + 0.5 * a + b, 1, a + 0.5 * b]),
    particle(parent = panel, mass = 1, position = [a, 1 - b, 1 - a + b]),
    particle(parent = panel, mass = 4, position = [1 + 0.5 * b, -1 + a + 0.5 * b, 2 + 0.5 * a]),
    potential = 2 * a * a + 0.5 * k * b * b
]);

// In the plane components are taken in the axes of the observer.
pair!(in_the_plane: ModalPlane ParticlesPlane, SVector::from([0.3, -0.4, 0.2]), [
    coordinates(x, turn, a),
    body(cart, position = [x, 0, 0], mass = 2, inertia = [0, 0, 0])
] [
    body(boom, parent = cart, position = [0, 0, 0.5], rotation = rotation_y(turn),
        mass = 8, center_of_mass = [1.125, 0, 1.375], inertia = [19, 0, -12, 32, 0, 13]),
    modes(boom, coordinates = [a], translation = [[2, 0, 4]], rotation = [[0, -5, 0]], mass = [6.5], stiffness = [k],
        inertia = [[10, 14, 4, 0, -9, 0]], second_inertia = [[[10, 13, 3, 0, 0, 0]]])
] [
    frame(boom, parent = cart, position = [0, 0, 0.5], rotation = rotation_y(turn)),
    particle(parent = boom, mass = 1, position = [1, 0, a]),
    particle(parent = boom, mass = 2, position = [2 + 0.5 * a, 0, 1 + a]),
    particle(parent = boom, mass = 1, position = [a, 0, 1 - a]),
    particle(parent = boom, mass = 4, position = [1, 0, 2 + 0.5 * a]),
    potential = 0.5 * k * a * a
]);

// The craft moves in a chart, and the panel is fixed to it.
pair!(in_a_chart: ModalChart ParticlesChart, (Isometry3::<f64>::identity(), SVector::from([0.2, -0.3])), [
    chart = hybrid, coordinates(a, b), mass = 20, center_of_mass = [0.1, 0, 0.2], inertia = [5, 6, 7]
] [
    body(panel, parent = body, position = [0.5, 0.1, 0],
        mass = 8, center_of_mass = [1.125, -0.125, 1.125], inertia = [24, 0, -8, 30, 7, 20]),
    modes(panel, coordinates = [a, b],
        translation = [[2, 4, 4], [4, 2, 2]],
        rotation = [[-9, -6, 2], [-1, 2, 3]],
        mass = [[10.5, 3], [3, 7.5]],
        stiffness = [4, k],
        inertia = [[-2, 10, -4, -6, -8, -7], [-4, 14, 6, -3, -6, -5]],
        gyroscopic = [[[0, 0, 0], [3, -1.5, 3]], [[-3, 1.5, -3], [0, 0, 0]]],
        second_inertia = [[[18, 13, 11, 0, 0, -4], [4, 2, 6, -1, -4.5, -3]],
                          [[4, 2, 6, -1, -4.5, -3], [9, 9, 12, -2, -2, 2]]])
] [
    frame(panel, parent = body, position = [0.5, 0.1, 0]),
    particle(parent = panel, mass = 1, position = [1, b, a]),
    particle(parent = panel, mass = 2, position = [2 + 0.5 * a + b, 1, a + 0.5 * b]),
    particle(parent = panel, mass = 1, position = [a, 1 - b, 1 - a + b]),
    particle(parent = panel, mass = 4, position = [1 + 0.5 * b, -1 + a + 0.5 * b, 2 + 0.5 * a]),
    potential = 2 * a * a + 0.5 * k * b * b
]);

// A constraint that is solved for one of the speeds.
pair!(with_a_constraint_that_is_solved: ModalSolved ParticlesSolved, SVector::from([0.4, 0.2, -0.3]), [
    coordinates(theta, a, b),
    speeds(v, p, r),
    kinematics(theta = v + a * p, a = p * cos(theta) - 2 * r, b = r + 0.3 * v),
    constraint(velocity = v - (1 + a * a) * p + 0.5 * r),
    independent(p, r)
] [
    body(panel, position = [0.3, 0.1, 0], rotation = rotation_y(theta),
        mass = 8, center_of_mass = [1.125, -0.125, 1.125], inertia = [24, 0, -8, 30, 7, 20]),
    modes(panel, coordinates = [a, b],
        translation = [[2, 4, 4], [4, 2, 2]],
        rotation = [[-9, -6, 2], [-1, 2, 3]],
        mass = [[10.5, 3], [3, 7.5]],
        stiffness = [4, k],
        inertia = [[-2, 10, -4, -6, -8, -7], [-4, 14, 6, -3, -6, -5]],
        gyroscopic = [[[0, 0, 0], [3, -1.5, 3]], [[-3, 1.5, -3], [0, 0, 0]]],
        second_inertia = [[[18, 13, 11, 0, 0, -4], [4, 2, 6, -1, -4.5, -3]],
                          [[4, 2, 6, -1, -4.5, -3], [9, 9, 12, -2, -2, 2]]])
] [
    frame(panel, position = [0.3, 0.1, 0], rotation = rotation_y(theta)),
    particle(parent = panel, mass = 1, position = [1, b, a]),
    particle(parent = panel, mass = 2, position = [2 + 0.5 * a + b, 1, a + 0.5 * b]),
    particle(parent = panel, mass = 1, position = [a, 1 - b, 1 - a + b]),
    particle(parent = panel, mass = 4, position = [1 + 0.5 * b, -1 + a + 0.5 * b, 2 + 0.5 * a]),
    potential = 2 * a * a + 0.5 * k * b * b
]);

/// The scene, with what is further wanted of the kernel.
macro_rules! wanted {
    ($modal:ident $beside:ident, [$($wanted:tt)+]) => {
        #[derive(GaussDynamics)]
        #[gauss($($wanted)+,
            gravity = [1.5, -2, -9.81],
            coordinates(base: Pose, theta, a, b),
            body(hull, pose = base, mass = m, center_of_mass = [0.1, 0, 0.2], inertia = [5, 6, 7]),
            body(panel, parent = hull, position = [0.5, 0.1, 0], rotation = rotation_z(theta),
                mass = 8, center_of_mass = [1.125, -0.125, 1.125], inertia = [24, 0, -8, 30, 7, 20]),
            modes(panel, coordinates = [a, b],
                translation = [[2, 4, 4], [4, 2, 2]],
                rotation = [[-9, -6, 2], [-1, 2, 3]],
                mass = [[10.5, 3], [3, 7.5]],
                stiffness = [4, k],
                inertia = [[-2, 10, -4, -6, -8, -7], [-4, 14, 6, -3, -6, -5]],
                gyroscopic = [[[0, 0, 0], [3, -1.5, 3]], [[-3, 1.5, -3], [0, 0, 0]]],
                second_inertia = [[[18, 13, 11, 0, 0, -4], [4, 2, 6, -1, -4.5, -3]],
                                  [[4, 2, 6, -1, -4.5, -3], [9, 9, 12, -2, -2, 2]]]))]
        struct $modal<T> {
            m: T,
            k: T,
        }

        #[derive(GaussDynamics)]
        #[gauss($($wanted)+,
            gravity = [1.5, -2, -9.81],
            coordinates(base: Pose, theta, a, b),
            body(hull, pose = base, mass = m, center_of_mass = [0.1, 0, 0.2], inertia = [5, 6, 7]),
            frame(panel, parent = hull, position = [0.5, 0.1, 0], rotation = rotation_z(theta)),
            particle(parent = panel, mass = 1, position = [1, b, a]),
            particle(parent = panel, mass = 2, position = [2 + 0.5 * a + b, 1, a + 0.5 * b]),
            particle(parent = panel, mass = 1, position = [a, 1 - b, 1 - a + b]),
            particle(parent = panel, mass = 4, position = [1 + 0.5 * b, -1 + a + 0.5 * b, 2 + 0.5 * a]),
            potential = 2 * a * a + 0.5 * k * b * b)]
        struct $beside<T> {
            m: T,
            k: T,
        }
    };
}

wanted!(ModalWhole ParticlesWhole, [
    methods(centroidal, nonlinear_effects, gravity_torques), reactions(panel)
]);
wanted!(ModalDerived ParticlesDerived, [linearize(parameters, inverse, hessian), regressor]);

type Place = (Isometry3<Bounded>, SVector<Bounded, 3>);

fn states() -> impl Iterator<Item = (Place, SVector<Bounded, 9>)> {
    let origin = (Isometry3::<f64>::identity(), SVector::from([0.4, 0.2, -0.3]));
    let mut random = Random(11);
    (0..6).map(move |_| {
        let q: Place = random_configuration(&origin, &mut random);
        (q, SVector::from_fn(|_, _| Bounded::from_f64(random.number())))
    })
}

/// Sums over all matter, and what the hinge bears.
#[test]
fn the_whole_has_what_bends() {
    let [m, k] = [20.0, 6.0].map(Bounded::from_f64);
    let (modal, beside) = (ModalWhole { m, k }.kernel().unwrap(), ParticlesWhole { m, k }.kernel().unwrap());
    let t = Bounded::zero();
    for (q, z) in states() {
        let both = |what: &str, ours: &[Bounded], theirs: &[Bounded]| equal(what, ours, theirs).unwrap();
        let slice = |a: &Vector3<Bounded>| a.as_slice().to_vec();
        both("centre", &slice(&modal.center_of_mass(t, &q)), &slice(&beside.center_of_mass(t, &q)));
        let [ours, theirs] = [modal.centroidal_momentum(t, &q, &z), beside.centroidal_momentum(t, &q, &z)];
        both("momentum", ours.as_slice(), theirs.as_slice());
        let [ours, theirs] = [modal.centroidal_matrix(t, &q), beside.centroidal_matrix(t, &q)];
        both("matrix", ours.as_slice(), theirs.as_slice());
        let [ours, theirs] = [modal.centroidal_bias(t, &q, &z), beside.centroidal_bias(t, &q, &z)];
        both("bias", ours.as_slice(), theirs.as_slice());
        let [ours, theirs] = [modal.gravity_torques(t, &q), beside.gravity_torques(t, &q)];
        both("weights", ours.as_slice(), theirs.as_slice());
        let [ours, theirs] = [modal.nonlinear_effects(t, &q, &z, &()), beside.nonlinear_effects(t, &q, &z, &())];
        both("effects", ours.as_slice(), theirs.as_slice());
        let ours = modal.reaction(ModalWholeJoint::panel, t, &q, &z, &());
        let theirs = beside.reaction(ParticlesWholeJoint::panel, t, &q, &z, &());
        both("reaction", ours.as_slice(), theirs.as_slice());
    }
}

/// Derivatives by state and parameters, of accelerations and of inverse dynamics, first and second; and the parts of
/// forces that are linear in inertial parameters, and those that are not.
#[test]
fn derivatives() {
    let [m, k] = [20.0, 6.0].map(Bounded::from_f64);
    let (modal, beside) = (ModalDerived { m, k }.kernel().unwrap(), ParticlesDerived { m, k }.kernel().unwrap());
    let t = Bounded::zero();
    for (q, z) in states() {
        let both = |what: &str, ours: &[Bounded], theirs: &[Bounded]| equal(what, ours, theirs).unwrap();
        let [ours, theirs] = [modal.linearize(t, &q, &z, &()), beside.linearize(t, &q, &z, &())];
        both("by state", ours.by_state.as_slice(), theirs.by_state.as_slice());
        let [ours, theirs] = [modal.by_parameters(t, &q, &z, &()), beside.by_parameters(t, &q, &z, &())];
        both("by parameters", ours.as_slice(), theirs.as_slice());
        let rates = z * Bounded::from_f64(0.7);
        let ours = modal.linearize_inverse(t, &q, &z, &rates, &());
        let theirs = beside.linearize_inverse(t, &q, &z, &rates, &());
        both("inverse", ours.by_configuration.as_slice(), theirs.by_configuration.as_slice());
        both("inverse", ours.by_speeds.as_slice(), theirs.by_speeds.as_slice());
        let weights = SVector::<Bounded, 18>::from_fn(|i, _| rates[i % 9]);
        let [ours, theirs] = [modal.hessian(t, &q, &z, &(), &weights), beside.hessian(t, &q, &z, &(), &weights)];
        both("second", ours.by_state.as_slice(), theirs.by_state.as_slice());
        let forces = modal.regressor(t, &q, &z, &rates) * modal.inertial_parameters()[0];
        let residual = forces - modal.other_forces(t, &q, &z, &rates, &());
        both("regressor", residual.as_slice(), modal.gauss_residual(t, &q, &z, &rates, &()).as_slice());
    }
}

/// Central gravity to second order, where particles feel all of it: what is left out of forces is of the order of the
/// square of size over distance, and falls so; of energies of its cube.
#[test]
fn a_distant_centre_pulls_at_what_bends() {
    let left_out = [1e3, 1e4].map(|distance| {
        let mu = 10.0 * distance * distance;
        let (modal, beside) = (ModalOrbit { mu }.kernel().unwrap(), ParticlesOrbit { mu }.kernel().unwrap());
        let turned = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.8, 0.5));
        let place = Vector3::new(0.6, -0.8, 0.0) * distance;
        let q = (Isometry3::from_parts(place.into(), turned), SVector::from([0.3, -0.2]));
        let z = SVector::<f64, 8>::from([0.1, 0.2, -0.3, 0.4, -0.5, 0.6, 0.7, -0.8]);
        let (ours, theirs) = (modal.acceleration(0.0, &q, &z, &()), beside.acceleration(0.0, &q, &z, &()));
        assert!(theirs.norm() > 1.0);
        let energies = [modal.potential_energy(0.0, &q), beside.potential_energy(0.0, &q)];
        [(ours - theirs).norm() / theirs.norm(), (energies[0] / energies[1] - 1.0).abs()]
    });
    // The farthest particle is 2.5 from O.
    let [[near, of_near], [far, of_far]] = left_out;
    assert!(near < 10.0 * (2.5_f64 / 1e3).powi(2) && of_near < 10.0 * (2.5_f64 / 1e3).powi(3), "{near} {of_near}");
    assert!(far < near / 90.0 && of_far < of_near / 900.0, "{far} {near}, {of_far} {of_near}");
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(base: Pose, a, b),
    central_gravity(mu = mu),
    body(panel, pose = base, mass = 8, center_of_mass = [1.125, -0.125, 1.125], inertia = [24, 0, -8, 30, 7, 20]),
    modes(panel, coordinates = [a, b],
        translation = [[2, 4, 4], [4, 2, 2]],
        rotation = [[-9, -6, 2], [-1, 2, 3]],
        mass = [[10.5, 3], [3, 7.5]],
        stiffness = [4, 6],
        inertia = [[-2, 10, -4, -6, -8, -7], [-4, 14, 6, -3, -6, -5]],
        gyroscopic = [[[0, 0, 0], [3, -1.5, 3]], [[-3, 1.5, -3], [0, 0, 0]]],
        second_inertia = [[[18, 13, 11, 0, 0, -4], [4, 2, 6, -1, -4.5, -3]],
                          [[4, 2, 6, -1, -4.5, -3], [9, 9, 12, -2, -2, 2]]]),
)]
struct ModalOrbit {
    mu: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(base: Pose, a, b),
    central_gravity(mu = mu),
    frame(panel, pose = base),
    particle(parent = panel, mass = 1, position = [1, b, a]),
    particle(parent = panel, mass = 2, position = [2 + 0.5 * a + b, 1, a + 0.5 * b]),
    particle(parent = panel, mass = 1, position = [a, 1 - b, 1 - a + b]),
    particle(parent = panel, mass = 4, position = [1 + 0.5 * b, -1 + a + 0.5 * b, 2 + 0.5 * a]),
    potential = 2 * a * a + 3 * b * b,
)]
struct ParticlesOrbit {
    mu: f64,
}
