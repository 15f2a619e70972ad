//! Kernels at run time beside compiled ones of the same structs: the same numbers, the same refusals.

mod bounded;

use gauss_codegen::Derivation;
use gauss_jit::{Kernel, KernelError, Model};
use gauss_runtime::error::ParameterWarnings;
use gauss_runtime::linearize::LinearModel;
use gauss_runtime::prelude::*;

/// A struct with its kernel, and the text of it.
macro_rules! scene {
    ($name:ident, { $($tokens:tt)* }) => {
        mod $name {
            use gauss_runtime::prelude::*;

            #[derive(Clone, Copy, GaussDynamics)]
            $($tokens)*

            pub const SOURCE: &str = stringify!($($tokens)*);
        }
    };
}

scene!(arms, {
    #[gauss(
        coordinates(a, b), linearize, input(motor),
        body(upper, rotation = rotation_y(a)),
        body(lower, parent = upper, position = [0, 0, -l], rotation = rotation_y(b)),
        spring(along = a - b, stiffness = k, length = 0.1), drive(a = motor),
    )]
    pub struct Arms {
        #[gauss(body)]
        pub upper: RigidBody<f64>,
        #[gauss(body)]
        pub lower: RigidBody<f64>,
        pub k: f64,
        pub l: f64,
        #[gauss(gravity)]
        pub g: f64,
    }
});

scene!(torpedo, {
    #[gauss(chart = left_invariant)]
    pub struct Torpedo {
        #[gauss(mass)]
        pub m: f64,
        #[gauss(center_of_mass)]
        pub c: Vector3<f64>,
        #[gauss(inertia)]
        pub i: Matrix3<f64>,
        #[gauss(added_mass)]
        pub x: Matrix6<f64>,
        #[gauss(gravity)]
        pub g: f64,
    }
});

scene!(plates, {
    #[gauss(
        coordinates(x, s), particle(mass = m, position = [x, 0, 0]), armature(s = j),
        body(rod, position = [x, 0, 0], rotation = rotation_z(s), mass = n, inertia = [0, 0, 0]),
        stop(along = x, least = low, most = high, stiffness = k, width = w),
    )]
    pub struct Plates {
        pub m: f64,
        pub n: f64,
        pub j: f64,
        pub low: f64,
        pub high: f64,
        pub k: f64,
        pub w: f64,
    }
});

scene!(murky, {
    #[gauss(chart = hybrid, drag(hull, linear = linear, quadratic = quadratic))]
    pub struct Murky {
        #[gauss(mass)]
        pub m: f64,
        #[gauss(inertia)]
        pub i: f64,
        #[gauss(added_mass)]
        pub added: Vector6<f64>,
        pub linear: Matrix6<f64>,
        pub quadratic: Vector6<f64>,
        #[gauss(gravity)]
        pub g: f64,
    }
});

scene!(mounted, {
    #[gauss(
        coordinates(place: Pose, a), body(rod, pose = place, mass = 1, inertia = [1, 1, 1]),
        body(sledge, position = [a, 0, 0], mass = 1, inertia = [1, 1, 1]),
        spring(along = a, stiffness = 1, damping = c),
        bushing(mount, body = rod, other = sledge, stiffness = [1, 1, 1, 1, 1, 1], damping = d),
        central_gravity(sun, mu = mu),
        damping = e * rate(a) * rate(a) * (1 + a * a),
    )]
    pub struct Mounted {
        pub c: f64,
        pub d: Matrix6<f64>,
        pub e: f64,
        pub mu: f64,
    }
});

fn model(source: &str) -> Model {
    Model::from_source(source).unwrap_or_else(|mistakes| panic!("{mistakes}\n{source}"))
}

/// A struct at run time, with numbers for its parameters.
struct Loaded {
    derivation: Derivation,
    kernel: Kernel,
    /// What the constants are computed from.
    numbers: Vec<f64>,
}

impl Loaded {
    fn new(source: &str, parameters: &[(&str, &[f64])]) -> Self {
        let derivation = Derivation::of_text(source).expect("a scene");
        let kernel = model(source).kernel(parameters).unwrap_or_else(|error| panic!("{error}"));
        let of = |name: &str| parameters.iter().find(|(known, _)| *known == name).expect("a parameter").1;
        let all: Vec<f64> = derivation.parameters().list.iter().flat_map(|p| of(&p.name).to_vec()).collect();
        let numbers = derivation.parameters().read.iter().map(|&k| all[k]).collect();
        Self { derivation, kernel, numbers }
    }

    fn assert_close(&self, method: &str, lists: &[&[f64]], compiled: &[f64]) {
        let outputs = self.derivation.program(method).expect("a method").code.outputs.len();
        assert_eq!(outputs, compiled.len(), "{method}");
        self.assert_close_from(method, lists, 0, compiled);
    }

    /// Some results: both ways are within the bound on the rounding of the program, constants included.
    fn assert_close_from(&self, method: &str, lists: &[&[f64]], first: usize, compiled: &[f64]) {
        let found = self.kernel.call(method, lists).unwrap_or_else(|error| panic!("{error}"));
        let program = self.derivation.program(method).expect("a method");
        let bounds = bounded::of_parameters(self.derivation.constants(), &self.numbers, program, lists);
        for ((compiled, found), (value, bound)) in compiled.iter().zip(&found[first..]).zip(&bounds[first..]) {
            assert!(*bound <= 1e-9 * value.abs().max(1.0), "{method}: the bound {bound} says nothing");
            assert!(
                (found - compiled).abs() <= 2.0 * bound,
                "{method}: {found} and compiled {compiled}, bound {bound}"
            );
        }
    }
}

#[test]
fn bodies_in_a_chain_are_those_of_the_compiled_kernel() {
    let tensor = [[0.3, 0.01, 0.0], [0.01, 0.2, -0.02], [0.0, -0.02, 0.25]];
    let body = |mass: f64, z: f64| RigidBody {
        mass,
        center_of_mass: Vector3::new(0.1, 0.0, z),
        inertia: Matrix3::from_fn(|i, j| tensor[i][j] + if i == j { 0.2 } else { 0.0 }),
    };
    let (upper, lower) = (body(1.0, -0.2), body(0.7, -0.1));
    let compiled = arms::Arms { upper, lower, k: 2.5, l: 0.7, g: 9.81 }.kernel().expect("bodies");
    let inertia: Vec<f64> = upper.inertia.iter().copied().collect();
    let parameters: [(&str, &[f64]); 9] = [
        ("g", &[9.81]),
        ("upper.mass", &[1.0]),
        ("upper.center_of_mass", &[0.1, 0.0, -0.2]),
        ("upper.inertia", &inertia),
        ("lower.mass", &[0.7]),
        ("lower.center_of_mass", &[0.1, 0.0, -0.1]),
        ("lower.inertia", &inertia),
        ("k", &[2.5]),
        ("l", &[0.7]),
    ];
    let loaded = Loaded::new(arms::SOURCE, &parameters);
    let (t, q, z, u, a) = ([0.3], [0.4, -1.2], [0.7, 2.0], [0.5], [1.0, -0.5]);
    let (vq, vz, vu, va) = (q.into(), z.into(), SVector::from(u), a.into());
    loaded.assert_close("acceleration", &[&t, &q, &z, &u], compiled.acceleration(t[0], &vq, &vz, &vu).as_slice());
    let forces = compiled.inverse_dynamics(t[0], &vq, &vz, &va, &vu);
    loaded.assert_close("gauss_residual", &[&t, &q, &z, &a, &u], forces.as_slice());
    assert_eq!(
        loaded.kernel.call("gauss_residual", &[&t, &q, &z, &a, &u]),
        loaded.kernel.inverse_dynamics(t[0], &q, &z, &a, &u)
    );
    loaded.assert_close("mass_matrix", &[&t, &q], compiled.mass_matrix(t[0], &vq).transpose().as_slice());
    loaded.assert_close("kinetic_energy", &[&t, &q, &z], &[compiled.kinetic_energy(t[0], &vq, &vz)]);
    loaded.assert_close("potential_energy", &[&t, &q], &[compiled.potential_energy(t[0], &vq)]);
    let linear = compiled.linearize(t[0], &vq, &vz, &vu);
    let by_state = (0..4).flat_map(|i| (0..4).map(move |j| (i, j))).map(|(i, j)| linear.by_state(i, j));
    // The rates of angles and speeds come before.
    loaded.assert_close_from("linearize", &[&t, &q, &z, &u], 4, &by_state.collect::<Vec<f64>>());
}

#[test]
fn a_body_with_added_mass_is_that_of_the_compiled_kernel() {
    let tensor = [[0.5, 0.0, 0.05], [0.0, 0.8, 0.0], [0.05, 0.0, 0.9]];
    let added = |i: usize, j: usize| if i == j { 0.3 + 0.1 * i as f64 } else { 0.01 * (i + j) as f64 };
    let body = torpedo::Torpedo {
        m: 2.0,
        c: Vector3::new(0.05, 0.0, 0.1),
        i: Matrix3::from_fn(|i, j| tensor[i][j]),
        x: Matrix6::from_fn(added),
        g: 9.81,
    };
    let compiled = body.kernel().expect("a body");
    let matrix: Vec<f64> = body.x.iter().copied().collect();
    let parameters: [(&str, &[f64]); 5] =
        [("m", &[2.0]), ("c", &[0.05, 0.0, 0.1]), ("i", &tensor.concat()), ("x", &matrix), ("g", &[9.81])];
    let loaded = Loaded::new(torpedo::SOURCE, &parameters);
    let rotation = UnitQuaternion::from_euler_angles(0.3, -0.4, 1.1);
    let pose = Isometry3::from_parts(Vector3::new(1.0, 2.0, -0.5).into(), rotation);
    let q: Vec<f64> = rotation.coords.iter().copied().chain([1.0, 2.0, -0.5]).collect();
    let z = [0.4, -0.2, 0.9, 1.5, -0.7, 0.3];
    let acceleration = compiled.acceleration(0.0, &pose, &z.into(), &());
    loaded.assert_close("acceleration", &[&[0.0], &q, &z, &[]], acceleration.as_slice());
    loaded.assert_close("mass_matrix", &[&[0.0], &q], compiled.mass_matrix(0.0, &pose).as_slice());
    loaded.assert_close("potential_energy", &[&[0.0], &q], &[compiled.potential_energy(0.0, &pose)]);
}

/// Whatever a compiled struct refuses is refused in the same words, all at once.
#[test]
fn parameters_are_refused_as_by_compiled_structs() {
    let values = [-1.0, 0.0, 1.0, f64::NAN, 1e200, 1e-200, 3.0];
    let mut random = 7_u64;
    let mut next = || {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        values[(random >> 40) as usize % values.len()]
    };
    let (mut refused, mut taken) = (0, 0);
    let mut compare = |compiled: Result<(), String>, found: Result<Kernel, KernelError>| {
        let found = found.map(drop).map_err(|error| {
            assert!(matches!(error, KernelError::Parameters(_)), "{error}");
            error.to_string()
        });
        *(if compiled.is_ok() { &mut taken } else { &mut refused }) += 1;
        assert_eq!(found, compiled);
    };
    let (plates, torpedo) = (model(plates::SOURCE), model(torpedo::SOURCE));
    for round in 0..400 {
        // Some are as they should be.
        let mut number = |right: f64| if (round + (right * 8.0) as usize).is_multiple_of(3) { next() } else { right };
        let [m, n, j, low, high, k, w] = [1.0, 0.5, 0.25, -1.0, 1.5, 100.0, 0.125].map(&mut number);
        let compiled = plates::Plates { m, n, j, low, high, k, w }.kernel().map(drop).map_err(|e| e.to_string());
        let names = ["m", "n", "j", "low", "high", "k", "w"];
        let numbers = [m, n, j, low, high, k, w];
        let given: Vec<(&str, &[f64])> = names.into_iter().zip(numbers.chunks(1)).collect();
        compare(compiled, plates.kernel(&given));

        let c: [f64; 3] = [0.05, 0.0, 0.1].map(&mut number);
        let mut i = [0.5, 0.0, 0.05, 0.0, 0.8, 0.0, 0.05, 0.0, 0.9];
        i[round % 9] = number(i[round % 9]);
        let mut x: [f64; 36] = std::array::from_fn(|k| if k % 7 == 0 { 0.5 } else { 0.0 });
        x[round % 36] = number(x[round % 36]);
        let body = torpedo::Torpedo {
            m,
            c: c.into(),
            i: Matrix3::from_row_slice(&i),
            x: Matrix6::from_row_slice(&x),
            g: 9.81,
        };
        let compiled = body.kernel().map(drop).map_err(|e| e.to_string());
        compare(compiled, torpedo.kernel(&[("m", &[m]), ("c", &c), ("i", &i), ("x", &x), ("g", &[9.81])]));
    }
    println!("{refused} refused, {taken} taken");
    assert!(refused > 100 && taken > 100);
}

/// Every rule whose breach is likely not meant, each broken by itself and all together.
#[test]
fn warnings_are_those_of_compiled_structs() {
    let numbers = |matrix: &Matrix6<f64>| matrix.transpose().as_slice().to_vec();
    let (murky, mounted) = (model(murky::SOURCE), model(mounted::SOURCE));
    let mut told = 0;
    let mut compare = |compiled: ParameterWarnings, kernel: Kernel, broken: usize| {
        assert_eq!(kernel.warnings().to_string(), compiled.to_string());
        assert!(compiled.is_empty() == (broken == 0));
        told += compiled.iter().count();
    };
    for broken in 0..16_usize {
        let sign = |bit: usize| if broken >> bit & 1 == 1 { -1.0 } else { 1.0 };
        let mut linear = Matrix6::identity();
        (linear[(0, 4)], linear[(4, 0)]) = (1.0 - sign(0), 1.0 - sign(0));
        let quadratic = [1.0, 1.0, sign(1) * 0.75, 1.0, 1.0, 1.0];
        let added = [0.5, 0.25 * sign(2), 0.5, 0.0, 0.0, 0.0];
        let (i, g) = (4.0, 9.81 * sign(3));
        let compiled =
            murky::Murky { m: 2.0, i, added: added.into(), linear, quadratic: quadratic.into(), g }.warnings();
        let given: [(&str, &[f64]); 6] = [
            ("m", &[2.0]),
            ("i", &[i]),
            ("added", &added),
            ("linear", &numbers(&linear)),
            ("quadratic", &quadratic),
            ("g", &[g]),
        ];
        compare(compiled, murky.kernel(&given).expect("a body all the same"), broken);
        let mut d = Matrix6::identity();
        (d[(0, 1)], d[(1, 0)]) = (1.5 - 1.5 * sign(0), 1.5 - 1.5 * sign(0));
        let (c, e, mu) = (0.5 * sign(1), 0.25 * sign(2), 3.0 * sign(3));
        let compiled = mounted::Mounted { c, d, e, mu }.warnings();
        let given: [(&str, &[f64]); 4] = [("c", &[c]), ("d", &numbers(&d)), ("e", &[e]), ("mu", &[mu])];
        compare(compiled, mounted.kernel(&given).expect("a mount all the same"), broken);
    }
    // Eight rules, each of which half of the rounds break.
    assert_eq!(told, 8 * 8);
}

/// A run keeps the energy, or takes the work of its input.
#[test]
fn simulations_take_models_at_run_time() {
    let source = "#[gauss(coordinates(a, b), input(motor), drive(a = motor),
        particle(mass = 1, position = [sin(a), 0, -cos(a)]),
        particle(mass = 0.5, position = [sin(a) + sin(b), 0, -cos(a) - cos(b)]), gravity = 9.81)] struct Double {}";
    let kernel = model(source).kernel(&[]).expect("pendulums");
    let system = kernel.system::<2, 2, SVector<f64, 1>>().expect("two angles");
    let (q, z) = (system.configuration(&[1.0, 2.0]), SVector::from([0.0, 0.5]));
    let energy = system.energy(0.0, &q, &z);
    let free = |_t: f64, _q: &_, _z: &_| SVector::from([0.0]);
    let end = Simulation::new(&system).adaptive(1e-11, 1e-13).input(free).run_to_end(q, z, 0.0..5.0).expect("a run");
    // Local errors of 1e-11 over some thousand steps of a motion that is chaotic, of energies up to 20.
    assert!((system.energy(0.0, &end.q, &end.z) - energy).abs() < 1e-7);
    let power = |_t: f64, _q: &_, _z: &_| SVector::from([1.0]);
    let end = Simulation::new(&system).adaptive(1e-11, 1e-13).input(power).run_to_end(q, z, 0.0..1.0).expect("a run");
    let work = end.q.as_slice()[0] - q.as_slice()[0];
    assert!((system.energy(0.0, &end.q, &end.z) - energy - work).abs() < 1e-8);
}

/// Supplied power is all that changes the energy, also where the time moves what has no mass: belts, frames that turn,
/// the far end of a damper. By differences along the motion; the last two scenes have two elements and no guides.
#[test]
fn powers_of_what_the_time_moves() {
    let belt = "coordinates(a), particle(mass = 2, position = [a, 0, 0])";
    let wheel = "coordinates(a), body(b, rotation = rotation_z(a), mass = 1, inertia = 1)";
    let turning = "frame(c, rotation = rotation_z(0.5 * t))";
    for scene in [
        format!("{belt}, friction(f, along = a + t, viscous = 1.5)"),
        format!("{belt}, friction(f, along = a - 2 * t, dry = 3, width = 0.1)"),
        format!("{belt}, friction(f, from = [a, 0, 0], to = [5 + t, 0, 0], viscous = 1.5)"),
        format!("{belt}, spring(f, along = a - t * t, stiffness = 4, damping = 1)"),
        format!("{wheel}, {turning}, coupling(f, body = b, other = c, viscous = 1.5)"),
        format!("{wheel}, {turning}, torque(f, body = b, value = [0, 0, 1], reaction = c)"),
        format!("{belt}, friction(f, along = a, viscous = 1.5), force(g, at = [a, 0, 0], value = [sin(t), 0, 0])"),
        format!("{wheel}, torque(f, body = b, value = [0, 0, sin(t)]), friction(h, along = a, viscous = 0.2)"),
    ] {
        let model = match Model::from_source(&format!("#[gauss({scene})] struct Scene {{}}")) {
            Ok(model) => model,
            Err(mistakes) => panic!("{scene}: {mistakes}"),
        };
        let kernel = model.kernel(&[]).unwrap();
        for (t, q, z) in [(0.6, 0.4, 0.7), (-1.1, 2.0, -0.3), (0.2, -0.5, 0.0)] {
            let a = kernel.acceleration(t, &[q], &[z], &[]).unwrap()[0];
            let energy = |h: f64| {
                let (t, q, z) = (t + h, q + h * z + 0.5 * h * h * a, z + h * a);
                let potential = kernel.potential_energy(t, &[q]).unwrap_or(0.0);
                kernel.kinetic_energy(t, &[q], &[z]).unwrap() + potential
            };
            let step = 1e-5;
            let rate = (energy(step) - energy(-step)) / (2.0 * step);
            let supplied = kernel.call("supplied_power", &[&[t], &[q], &[z], &[]]).unwrap()[0];
            // Third derivatives of some hundred times the square of the step, and roundings over it.
            let bound = 1e3 * step * step + 100.0 * f64::EPSILON * energy(0.0).abs().max(1.0) / step;
            assert!((rate - supplied).abs() <= bound, "{scene}: {rate} {supplied}");
        }
        if scene.contains("sin(t)") {
            assert_eq!(kernel.method("powers").unwrap().outputs(), 2, "{scene}");
        }
    }
}
