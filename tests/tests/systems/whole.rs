//! Centre of mass and momenta about it against sums over bodies, by poses and twists of their frames, and against dual
//! numbers; nonlinear effects and gravity torques against the methods that they are parts of.

use crate::common::Bounded;
use crate::common::agreement::equal;
use crate::common::body::{Parts, apply, cross, list, speeds};
use crate::common::dual::Dual;
use crate::common::groups::{Random, random_configuration};
use gauss_runtime::prelude::*;

type Moving = Dual<Bounded>;

fn moving(values: &[Bounded], rates: &[Bounded]) -> Vec<Moving> {
    values.iter().zip(rates).map(|(&value, &rate)| Dual::new(value, rate)).collect()
}

fn rates<const N: usize>(duals: &SVector<Moving, N>) -> Vec<Bounded> {
    duals.iter().map(|x| x.rate).collect()
}

fn product<M: std::ops::Index<(usize, usize), Output = Bounded>>(
    rows: usize,
    matrix: &M,
    z: &[Bounded],
) -> Vec<Bounded> {
    let row = |i: usize| z.iter().enumerate().fold(Bounded::zero(), |sum, (k, &z)| sum + matrix[(i, k)] * z);
    (0..rows).map(row).collect()
}

fn sums(a: &[Bounded], b: &[Bounded]) -> Vec<Bounded> {
    a.iter().zip(b).map(|(&a, &b)| a + b).collect()
}

fn sum3(a: [Bounded; 3], b: [Bounded; 3]) -> [Bounded; 3] {
    [0, 1, 2].map(|i| a[i] + b[i])
}

fn scaled(s: Bounded, a: [Bounded; 3]) -> [Bounded; 3] {
    a.map(|x| s * x)
}

/// What has mass, in a frame of the system: a body, or a particle at its origin.
struct Matter<F> {
    frame: F,
    body: RigidBody<f64>,
}

/// Mass, (Q̂, Γ̂_Ω) and ∫x̂ dm, added up body by body.
fn summed<K: FramedSystem<Scalar = Bounded>>(
    kernel: &K,
    matter: &[Matter<K::Frame>],
    (t, q, z): (Bounded, &K::Configuration, &K::Speeds),
) -> (Bounded, [Bounded; 3], [[Bounded; 3]; 2]) {
    let none = [Bounded::zero(); 3];
    let (mut mass, mut first, mut linear, mut angular) = (Bounded::zero(), none, none, none);
    for Matter { frame, body } in matter {
        let number = Bounded::from_f64;
        let (m, c) = (number(body.mass), [0, 1, 2].map(|i| number(body.center_of_mass[i])));
        let inertia = [0, 1, 2].map(|i| [0, 1, 2].map(|k| number(body.inertia[(i, k)])));
        let (pose, twist) = (kernel.pose_of(*frame, t, q), kernel.twist_of(*frame, t, q, z));
        let r = [0, 1, 2].map(|i| [0, 1, 2].map(|k| pose.rotation.matrix()[(i, k)]));
        let b = [0, 1, 2].map(|i| pose.translation.vector[i]);
        let (u, w) = ([twist[0], twist[1], twist[2]], [twist[3], twist[4], twist[5]]);
        let momentum = apply(&r, scaled(m, sum3(u, cross(w, c))));
        let own = apply(&r, sum3(scaled(m, cross(c, u)), apply(&inertia, w)));
        mass += m;
        first = sum3(first, scaled(m, sum3(b, apply(&r, c))));
        linear = sum3(linear, momentum);
        angular = sum3(angular, sum3(own, cross(b, momentum)));
    }
    (mass, first, [linear, angular])
}

fn check<C, B, D>(origin: &C, bounded: &B, dual: &D, matter: &[Matter<B::Frame>])
where
    C: Configuration<Scalar = f64> + Parts<f64>,
    B: CentroidalSystem<Scalar = Bounded, Configuration: Parts<Bounded>, Input = ()> + FramedSystem + GravityTorques,
    D: CentroidalSystem<Scalar = Moving, Configuration: Parts<Moving>>,
{
    let mut random = Random(5);
    for _ in 0..8 {
        let q: B::Configuration = random_configuration(origin, &mut random);
        let mut draw = |n: usize| -> Vec<Bounded> { (0..n).map(|_| Bounded::from_f64(random.number())).collect() };
        let (z, acceleration, t) = (draw(B::DOF), draw(B::DOF), draw(1)[0]);
        let (now, still): (B::Speeds, B::Speeds) = (speeds(&z), speeds(&vec![Bounded::zero(); B::DOF]));
        let moving_q = D::Configuration::assemble(&moving(&q.parts(), &q.rates(&bounded.kinematics(t, &q, &now))));
        let (moving_z, moving_t) = (speeds(&moving(&z, &acceleration)), Dual::new(t, Bounded::one()));

        let (mass, first, [linear, angular]) = summed(bounded, matter, (t, &q, &now));
        equal("mass", &[bounded.total_mass()], &[mass]).unwrap();
        let center = bounded.center_of_mass(t, &q);
        equal("centre", &list(&center), &first.map(|x| x / mass)).unwrap();
        let about_origin = bounded.momentum_about(&Vector3::from([Bounded::zero(); 3]), t, &q, &now);
        equal("momentum", &list(&about_origin), &[linear, angular].concat()).unwrap();
        let momentum = list(&bounded.centroidal_momentum(t, &q, &now));
        equal("about the centre", &list(&bounded.momentum_about(&center, t, &q, &now)), &momentum).unwrap();

        let matrix = bounded.centroidal_matrix(t, &q);
        let guided = list(&bounded.centroidal_momentum(t, &q, &still));
        equal("A_G z", &sums(&product(6, &matrix, &z), &guided), &momentum).unwrap();
        let velocity = list(&bounded.center_velocity(t, &q, &now));
        equal("velocity of the centre", &velocity, &rates(&dual.center_of_mass(moving_t, &moving_q))).unwrap();
        let at_rest = list(&bounded.center_velocity(t, &q, &still));
        let by_jacobian = sums(&product(3, &bounded.center_jacobian(t, &q), &z), &at_rest);
        equal("its Jacobian", &by_jacobian, &velocity).unwrap();
        let rate = sums(&product(6, &matrix, &acceleration), &list(&bounded.centroidal_bias(t, &q, &now)));
        let expected = rates(&dual.centroidal_momentum(moving_t, &moving_q, &moving_z));
        equal("rate of momentum", &rate, &expected).unwrap();
        // Bounds are those of the worst case; they must be small, or agreement would say nothing.
        let size = expected.iter().fold(1.0_f64, |m, x| m.max(x.value.abs()));
        assert!(rate.iter().chain(&expected).all(|x| x.bound < 1e-10 * size), "{rate:?} {expected:?}");

        let effects = bounded.nonlinear_effects(t, &q, &now, &());
        let at_any_rate = bounded.inverse_dynamics(t, &q, &now, &still, &());
        equal("nonlinear effects", &list(&effects), &list(&at_any_rate)).unwrap();
        // Along each speed what holds the weight does the work that the potential energy gains.
        let torques = list(&bounded.gravity_torques(t, &q));
        for (k, torque) in torques.into_iter().enumerate() {
            let mut one = vec![Bounded::zero(); B::DOF];
            one[k] = Bounded::one();
            let velocity = q.rates(&bounded.kinematics(t, &q, &speeds(&one)));
            let moved = D::Configuration::assemble(&moving(&q.parts(), &velocity));
            let gained = dual.potential_energy(Dual::new(t, Bounded::zero()), &moved).rate;
            equal("gravity torques", &[torque], &[gained]).unwrap();
        }
    }
}

fn rigid(mass: f64, x: f64) -> RigidBody<f64> {
    let inertia = Matrix3::new(1.3, 0.1, -0.2, 0.1, 1.7, 0.05, -0.2, 0.05, 2.1);
    RigidBody { mass, center_of_mass: Vector3::new(x, 0.1, -0.05), inertia }
}

fn of<T: Real>(body: RigidBody<f64>) -> RigidBody<T> {
    let RigidBody { mass, center_of_mass, inertia } = body;
    RigidBody {
        mass: T::from_f64(mass),
        center_of_mass: center_of_mass.map(T::from_f64),
        inertia: inertia.map(T::from_f64),
    }
}

fn particle(mass: f64) -> RigidBody<f64> {
    RigidBody { mass, center_of_mass: Vector3::zeros(), inertia: Matrix3::zeros() }
}

macro_rules! both {
    ($name:ident) => {
        (&$name::<Bounded>::sample().kernel().unwrap(), &$name::<Moving>::sample().kernel().unwrap())
    };
}

/// A craft with a wheel, an arm that is guided, and matter that nothing moves.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(s, base: Pose, wheel: Rotation, elbow),
    speeds(u: Vector3, w: Vector3, v, spin: Vector3, bend),
    kinematics(base = twist(u, w), s = 2 * v - bend, wheel = spin, elbow = bend + s * v),
    body(hull, position = base.position, rotation = base.rotation),
    body(rotor, parent = hull, position = [0.2, 0, s], rotation = wheel),
    body(arm, parent = hull, position = [l, sin(t), 0], rotation = rotation_y(elbow) * rotation_x(t)),
    frame(tip, parent = arm, position = [0, 0, 0.5]),
    particle(mass = 0.3, parent = tip, position = [0, 0, 0]),
    body(stand, position = [1, 2, 3]),
    frames(hull, rotor, arm, tip, stand),
    methods(centroidal, nonlinear_effects, gravity_torques),
)]
struct Craft<T> {
    #[gauss(body)]
    hull: RigidBody<T>,
    #[gauss(body)]
    rotor: RigidBody<T>,
    #[gauss(body)]
    arm: RigidBody<T>,
    #[gauss(body)]
    stand: RigidBody<T>,
    l: T,
    #[gauss(gravity)]
    g: T,
}

impl<T: Real> Craft<T> {
    fn sample() -> Self {
        let [hull, rotor, arm, stand] = [rigid(2.0, 0.3), rigid(1.0, -0.1), rigid(0.5, 0.2), rigid(0.8, 0.1)].map(of);
        Self { hull, rotor, arm, stand, l: T::from_f64(0.4), g: T::from_f64(9.81) }
    }
}

#[test]
fn a_craft_with_an_arm() {
    let origin = (Isometry3::<f64>::identity(), (UnitQuaternion::<f64>::identity(), SVector::from([0.4, 0.2])));
    let (bounded, dual) = both!(Craft);
    let matter = [
        Matter { frame: CraftFrame::hull, body: rigid(2.0, 0.3) },
        Matter { frame: CraftFrame::rotor, body: rigid(1.0, -0.1) },
        Matter { frame: CraftFrame::arm, body: rigid(0.5, 0.2) },
        Matter { frame: CraftFrame::tip, body: particle(0.3) },
        Matter { frame: CraftFrame::stand, body: rigid(0.8, 0.1) },
    ];
    check(&origin, bounded, dual, &matter);
}

/// Everything turns about one axis, the first link about one that is fixed: its moments are regrouped.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(upper, rotation = rotation_y(a)),
    body(lower, parent = upper, position = [0, 0, l], rotation = rotation_y(b)),
    frames(upper, lower),
    methods(gravity_torques, nonlinear_effects, centroidal),
)]
struct Plane<T> {
    #[gauss(body)]
    upper: RigidBody<T>,
    #[gauss(body)]
    lower: RigidBody<T>,
    l: T,
    #[gauss(gravity)]
    g: T,
}

impl<T: Real> Plane<T> {
    fn sample() -> Self {
        Self { upper: of(rigid(2.0, 0.3)), lower: of(rigid(1.0, -0.1)), l: T::from_f64(0.4), g: T::from_f64(9.81) }
    }
}

#[test]
fn in_the_plane() {
    let (bounded, dual) = both!(Plane);
    let matter = [
        Matter { frame: PlaneFrame::upper, body: rigid(2.0, 0.3) },
        Matter { frame: PlaneFrame::lower, body: rigid(1.0, -0.1) },
    ];
    check(&SVector::<f64, 2>::zeros(), bounded, dual, &matter);
}

macro_rules! charted {
    ($test:ident: $name:ident $frame:ident, [$($chart:tt)+], $motion:ident, $origin:expr) => {
        #[derive(GaussDynamics)]
        #[gauss(chart = $($chart)+, motion = $motion, frames(body), methods(centroidal, nonlinear_effects, gravity_torques))]
        struct $name<T> {
            #[gauss(mass)]
            m: T,
            #[gauss(center_of_mass)]
            c: Vector3<T>,
            #[gauss(inertia)]
            inertia: Matrix3<T>,
            #[gauss(gravity)]
            g: T,
        }

        impl<T: Real> $name<T> {
            fn sample() -> Self {
                let RigidBody { mass, center_of_mass, inertia } = of(rigid(2.0, 0.3));
                Self { m: mass, c: center_of_mass, inertia, g: T::from_f64(9.81) }
            }
        }

        #[test]
        fn $test() {
            let (bounded, dual) = both!($name);
            check(&$origin, bounded, dual, &[Matter { frame: $frame::body, body: rigid(2.0, 0.3) }]);
        }
    };
}

charted!(free_left: FreeLeft FreeLeftFrame, [left_invariant], free, Isometry3::<f64>::identity());
charted!(free_right: FreeRight FreeRightFrame, [right_invariant], free, Isometry3::<f64>::identity());
charted!(free_hybrid: FreeHybrid FreeHybridFrame, [hybrid], free, Isometry3::<f64>::identity());
charted!(held_jet: HeldJet HeldJetFrame, [jet(modified_rodrigues)], fixed_point, SVector::<f64, 3>::zeros());
charted!(plane_jet: PlaneJet PlaneJetFrame, [jet], planar, SVector::<f64, 3>::zeros());
