//! One mistake is one message: what uses the kernel of a struct that is wrong gives no further errors.

use gauss_runtime::prelude::*;

#[derive(GaussDynamics)]
#[gauss(chart = hybird)]
struct Body {
    #[gauss(mass)]
    mass: f64,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
}

struct Experiment {
    kernel: BodyKernel,
    z: <BodyKernel as GaussSystem>::Speeds,
}

fn at_rest() -> BodyState {
    BodyState::default()
}

fn velocity() -> std::ops::Range<usize> {
    BodyIndex::u
}

fn degrees_of_freedom<K: GaussSystem>(_: &K) -> usize {
    K::DOF
}

#[derive(GaussDynamics)]
#[gauss(chart = hybrid, motoin = planar)]
struct Generic<T> {
    #[gauss(mass)]
    mass: T,
    #[gauss(inertia)]
    inertia: T,
}

fn energy<T: Real>(kernel: &GenericKernel<T>) -> T {
    kernel.potential_energy(T::zero(), &Isometry2::identity())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let body = Body { mass: 1.0, inertia: Vector3::new(1.0, 2.0, 3.0) };
    let kernel = body.kernel()?;
    let start = BodyState { omega_x: 1.0, ..Default::default() };
    let BodyState { omega_y, .. } = start;
    println!("{omega_y} {:?}", BodyState { omega_z: 2.0, ..at_rest() }.q());
    let (q, z) = (Isometry3::identity(), SVector::from([0.0, 0.0, 0.0, 1.0, 2.0, 3.0]));
    let acceleration = kernel.acceleration(0.0, &q, &z, &());
    println!("{acceleration} {} {}", acceleration[2], BodyKernel::DOF);
    let run = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(q, z, 0.0..1.0)?;
    println!("{}", kernel.energy(0.0, &run.last().q, &run.last().z));
    let experiment = Experiment { kernel, z: run.last().z };
    println!("{} {}", degrees_of_freedom(&experiment.kernel), experiment.z[0]);
    let generic = Generic { mass: 1.0, inertia: 2.0 };
    match generic.kernel() {
        Ok(kernel) => println!("{}", energy(&kernel)),
        Err(error) => println!("{error}"),
    }
    Ok(())
}
