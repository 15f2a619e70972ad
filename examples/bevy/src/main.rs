//! `cargo run` prints a second of motion; `cargo run --release --features window` shows it.

use gauss_bevy_example::{GaussPlugin, Handle, HandleKernel, Moving};
use gauss_runtime::prelude::*;

fn body() -> Result<Moving<HandleKernel>, ParameterError> {
    let kernel = Handle { mass: 0.3, inertia: Vector3::new(2e-3, 1.5e-2, 1.6e-2) }.kernel()?;
    Ok(Moving::new(kernel, Isometry3::identity(), Vector6::new(0.0, 0.0, 0.0, 0.01, 8.0, 0.01)))
}

#[cfg(not(feature = "window"))]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    use std::time::Duration;

    use bevy_app::App;
    use bevy_time::{TimePlugin, TimeUpdateStrategy};
    use bevy_transform::components::Transform;

    let mut app = App::new();
    app.add_plugins((TimePlugin, GaussPlugin::<HandleKernel>::default()));
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(100)));
    let entity = app.world_mut().spawn(body()?).id();
    for _ in 0..=10 {
        app.update();
        let found = (app.world().get::<Moving<HandleKernel>>(entity), app.world().get::<Transform>(entity));
        if let (Some(body), Some(transform)) = found {
            println!("physics at {:.3} s, shown: {}", body.time(), transform.rotation);
        }
    }
    Ok(())
}

#[cfg(feature = "window")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    use bevy::prelude::*;

    let body = body()?;
    let mut body = Some(body);
    let setup = move |mut commands: Commands,
                      mut meshes: ResMut<Assets<Mesh>>,
                      mut materials: ResMut<Assets<StandardMaterial>>| {
        commands.spawn((
            Camera3d::default(),
            bevy::prelude::Transform::from_xyz(0.9, 0.6, 0.9).looking_at(Vec3::ZERO, Vec3::Y),
        ));
        commands.spawn((
            DirectionalLight::default(),
            bevy::prelude::Transform::from_xyz(2.0, 4.0, 1.0).looking_at(Vec3::ZERO, Vec3::Y),
        ));
        // Edges along the axes of the body.
        let shape = Mesh3d(meshes.add(Cuboid::new(0.2, 0.6, 0.03)));
        let colour = MeshMaterial3d(materials.add(Color::srgb(0.0, 0.45, 0.7)));
        if let Some(body) = body.take() {
            commands.spawn((body, shape, colour));
        }
    };
    App::new().add_plugins((DefaultPlugins, GaussPlugin::<HandleKernel>::default())).add_systems(Startup, setup).run();
    Ok(())
}
