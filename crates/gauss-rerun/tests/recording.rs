//! A recording written to a file and read again.

use std::collections::BTreeSet;
use std::error::Error;
use std::fs;

use gauss_rerun::{RecordError, Recorder};
use gauss_runtime::prelude::*;
use rerun::{ChunkStore, ChunkStoreConfig, Ellipsoids3D, RecordingStreamBuilder};

/// Two rods; the lower one hangs from the end of the upper one.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(upper, rotation = rotation_y(a), mass = 1.0, center_of_mass = [0, 0, -0.5], inertia = [0.34, 0.34, 0.001]),
    body(
        lower, parent = upper, position = [0, 0, -1], rotation = rotation_y(b),
        mass = 1.0, center_of_mass = [0, 0, -0.5], inertia = [0.34, 0.34, 0.001],
    ),
    gravity = 9.81,
    frames(upper, lower),
)]
struct Pendulum {}

#[test]
fn what_is_written_is_read() -> Result<(), Box<dyn Error>> {
    let kernel = Pendulum {}.kernel()?;
    let (q, z) = (SVector::from([2.0, 0.5]), SVector::zeros());
    let path = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(q, z, 0.0..2.0)?;
    let file = std::env::temp_dir().join(format!("gauss_rerun_{}.rrd", std::process::id()));
    let stream = RecordingStreamBuilder::new("two rods").save(&file)?;
    Recorder::new(&stream, &path)?
        .frames(&kernel)?
        .shape("lower", &Ellipsoids3D::from_centers_and_half_sizes([[0.0, 0.0, -0.5]], [[0.02, 0.02, 0.5]]))?
        .trace("lower", "end", [0.0, 0.0, -1.0])?
        .arrow("weight", 0.05, |_| (Vector3::zeros(), Vector3::new(0.0, 0.0, -9.81)))?
        .scalar("rates", "a", |s| s.z[0])?
        .energy(&kernel)?;
    stream.flush_blocking()?;
    drop(stream);

    let stores = ChunkStore::from_rrd_reader(&ChunkStoreConfig::ALL_DISABLED, &mut fs::File::open(&file)?)?;
    let entities: BTreeSet<String> =
        stores.values().flat_map(|store| store.all_entities()).map(|entity| entity.to_string()).collect();
    for entity in [
        "/world",
        "/world/upper",
        "/world/lower",
        "/world/traces/end",
        "/world/arrows/weight",
        "/scalars/rates/a",
        "/scalars/energy/sum",
    ] {
        assert!(entities.contains(entity), "{entity}: {entities:?}");
    }
    let rows = |name: &str| -> usize {
        let chunks = stores.values().flat_map(|store| store.iter_physical_chunks());
        chunks.filter(|chunk| chunk.entity_path().to_string() == name).map(|chunk| chunk.num_rows()).sum()
    };
    // A row for each picture; of the lower rod one more, its shape.
    assert_eq!([rows("/world/upper"), rows("/world/lower"), rows("/scalars/energy/sum")], [600, 601, 600]);
    fs::remove_file(file)?;
    Ok(())
}

#[test]
fn names_are_known() -> Result<(), Box<dyn Error>> {
    let kernel = Pendulum {}.kernel()?;
    let path = Simulation::new(&kernel).fixed_step(0.1).run(SVector::zeros(), SVector::zeros(), 0.0..0.1)?;
    let (stream, _storage) = RecordingStreamBuilder::new("two rods").memory()?;
    let error = Recorder::new(&stream, &path)?.trace("hand", "end", [0.0; 3]).err().expect("refused");
    assert!(matches!(&error, RecordError::UnknownBody(name) if name == "hand"), "{error}");
    Ok(())
}
