// Scenes of test_fmus.py, of which `cargo gauss create --fmu` makes FMUs.

#[derive(GaussDynamics)]
#[gauss(coordinates(x), particle(mass = m, position = [x, 0, 0]), input(push = "N"), linearize, drive(x = push))]
struct Cart {
    #[gauss(unit = "kg")]
    m: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y), linearize,
    particle(mass = m, position = [x, 0, 0]), particle(mass = m, position = [y, 0, 0]),
    spring(along = y - x, stiffness = k, length = 1),
)]
struct Pair {
    m: f64,
    k: f64,
}

#[derive(GaussDynamics)]
#[gauss(
    coordinates(height), particle(mass = m, position = [0, 0, height]),
    contact(floor, gap = height, restitution = e), gravity = g,
)]
struct Ball {
    m: f64,
    e: f64,
    g: f64,
}

#[derive(GaussDynamics)]
#[gauss(motion = fixed_point, frames(body), linearize)]
struct Top {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    g: f64,
}
