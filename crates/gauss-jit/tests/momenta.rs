//! `momentum_rate` is the rate of `momentum` along the motion: by differences, which know neither of them.

use gauss_jit::Model;

/// A scene, with bodies that are the same however far they turn about their hinge, and others.
fn scenes() -> Vec<String> {
    let mut scenes = Vec::new();
    let inertias = ["[1, 1, 1]", "[1, 1, 1.2]", "[1.2, 1, 1]", "[1, 1.1, 1.2]"];
    let hubs = ["rotation = r", "rotation = r, position = [0.1, 0.2, 0.3]"];
    // The hinge of a wheel on a slide across its axis, along it, and on nothing that slides.
    let places = ["[b, 0, 0]", "[0, b, 0.3]", "[0, 0, b]", "[0.4, 0.1 * b * b, sin(b)]", "[0.3, 0, 0]"];
    for inertia in inertias {
        for hub in hubs {
            for place in places {
                for turn in ["rotation_z(a)", "rotation_x(a)", "rotation_x(b) * rotation_z(a)"] {
                    scenes.push(format!(
                        "coordinates(r: Rotation, b, a), gravity = 9.81, body(hub, {hub}, mass = 2, inertia = [1, 2, 2.5]), armature(b = 0.2),
                         body(wheel, parent = hub, position = {place}, rotation = {turn}, mass = 1,
                              center_of_mass = [0, 0, 0.1], inertia_about_center_of_mass = {inertia})"
                    ));
                }
            }
        }
        // A wheel on a wheel, about the same axis and another.
        for second in ["rotation_z(c)", "rotation_x(c)"] {
            scenes.push(format!(
                "coordinates(h, g, a, b, c), body(m, rotation = rotation_x(h) * rotation_y(g), mass = 2, inertia = [1, 2, 2]),
                 body(e, parent = m, position = [b, 0, 0], rotation = rotation_z(a), mass = 1, inertia = {inertia}),
                 body(f, parent = e, position = [0, 0, 0.2], rotation = {second}, mass = 0.5, inertia = {inertia}),
                 particle(mass = 0.3, parent = f, position = [0.1, b, 0.2]), spring(along = b, stiffness = 3)"
            ));
        }
        for chart in ["left_invariant", "hybrid", "right_invariant", "jet(euler_zyx)"] {
            scenes.push(format!(
                "chart = {chart}, mass = 3, inertia = [1, 2, 2.5], coordinates(b, a),
                 body(wheel, parent = body, position = [b, 0, 0], rotation = rotation_z(a), mass = 1, inertia = {inertia})"
            ));
        }
    }
    scenes
}

#[test]
fn momentum_rates_are_rates_of_momenta() {
    let mut random = 11_u64;
    let mut next = || {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    };
    for scene in scenes() {
        let model = Model::from_source(&format!("#[gauss({scene})] struct Scene {{}}"));
        let model = model.unwrap_or_else(|mistakes| panic!("{scene}: {mistakes}"));
        let kernel = model.kernel(&[]).unwrap_or_else(|error| panic!("{scene}: {error}"));
        let arguments = model.arguments("acceleration").expect("equations");
        let [mut q, z] = [1, 2].map(|k| (0..arguments[k].components.len()).map(|_| next()).collect::<Vec<f64>>());
        for unit in model.unit_components() {
            let length = q[unit.clone()].iter().map(|x| x * x).sum::<f64>().sqrt();
            q[unit.clone()].iter_mut().for_each(|x| *x /= length);
        }
        let call = |method: &str, q: &[f64], z: &[f64]| kernel.call(method, &[&[0.0], q, z]).expect("a method");
        let rate = kernel.acceleration(0.0, &q, &z, &[]).expect("accelerations");
        let velocity = call("kinematics", &q, &z);
        let h = 1e-4;
        let momentum = |by: f64| {
            let mut moved = vec![0.0; q.len()];
            let increment: Vec<f64> = velocity.iter().map(|v| by * v).collect();
            kernel.retract(&q, &increment, &mut moved).expect("sizes");
            let z: Vec<f64> = z.iter().zip(&rate).map(|(z, rate)| z + by * rate).collect();
            call("momentum", &moved, &z)
        };
        // Of order four in h.
        let points = [-2.0, -1.0, 1.0, 2.0].map(|k| momentum(k * h));
        let found = kernel.call("momentum_rate", &[&[0.0], &q, &momentum(0.0), &[]]).expect("momentum rates");
        for (k, found) in found.iter().enumerate() {
            let [a, b, c, d] = [0, 1, 2, 3].map(|point| points[point][k]);
            let expected = (a - 8.0 * b + 8.0 * c - d) / (12.0 * h);
            // h⁴ by fifth derivatives, and rounding of momenta up to ten over h.
            assert!(
                (found - expected).abs() <= 1e-9 * (1.0 + expected.abs()),
                "{scene}, p_{k}: {found} for {expected}"
            );
        }
    }
}
