//! A folder of derivations: what is read again computes the same bits, and what is not as it was is derived anew.
#![cfg(feature = "cache")]

use std::fs;
use std::path::{Path, PathBuf};

use gauss_jit::{Cache, Model, Notation};

const PENDULUM: &str = "#[gauss(coordinates(a, b), particle(mass = m, position = [l*sin(a), 0, -l*cos(a)]),
    particle(mass = 2, position = [l*sin(a) + l*sin(b), 0, -l*cos(a) - l*cos(b)]), gravity = 9.81,
    linearize(without_contacts), contact(floor, gap = 3*l - l*cos(a) - l*cos(b), slip = l*rate(b), friction = 0.4))]
    struct Pendulum { m: f64, #[gauss(unit = \"m\")] l: f64 }";

const ROBOT: &str = r#"<robot name="arm"><link name="base"/><link name="rod"><inertial><mass value="MASS"/>
    <origin xyz="0 0 -0.5"/><inertia ixx="0.1" iyy="0.1" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint></robot>"#;

/// A folder of its own, which is removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("gauss_cache_{name}_{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a folder");
        Self(folder)
    }

    /// The entries of a cache in it.
    fn entries(&self) -> Vec<PathBuf> {
        let all = fs::read_dir(self.0.join("cache")).into_iter().flatten().flatten().map(|entry| entry.path());
        let mut all: Vec<_> = all.collect();
        all.sort();
        all
    }

    fn cache(&self) -> Cache {
        Cache::new(self.0.join("cache"))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Both models are the same, word for word and bit for bit.
fn same(a: &Model, b: &Model) {
    assert_eq!(a.equations(Notation::Text), b.equations(Notation::Text));
    assert_eq!(a.equations(Notation::Latex), b.equations(Notation::Latex));
    assert_eq!((a.description(), a.parameters()), (b.description(), b.parameters()));
    assert_eq!((a.accuracy(), a.files(), a.remarks()), (b.accuracy(), b.files(), b.remarks()));
    assert_eq!((a.contacts(), a.unit_components()), (b.contacts(), b.unit_components()));
    assert!(a.methods().eq(b.methods()) && a.operations().eq(b.operations()));
    let numbers: Vec<(String, Vec<f64>)> =
        a.parameters().iter().map(|own| (own.name.clone(), vec![1.25; own.count])).collect();
    let numbers: Vec<(&str, &[f64])> = numbers.iter().map(|(name, list)| (name.as_str(), &list[..])).collect();
    let kernels = [a, b].map(|model| model.kernel(&numbers).expect("a kernel"));
    for method in a.methods() {
        let arguments: Vec<Vec<f64>> = a
            .arguments(method)
            .expect("a method")
            .iter()
            .enumerate()
            .map(|(i, own)| (0..own.components.len()).map(|k| 0.3 + 0.2 * i as f64 - 0.45 * k as f64).collect())
            .collect();
        let arguments: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
        let results = kernels.each_ref().map(|kernel| kernel.call(method, &arguments).expect("results"));
        let bits = results.map(|list| list.into_iter().map(f64::to_bits).collect::<Vec<_>>());
        assert_eq!(bits[0], bits[1], "{method}");
    }
}

/// A file is replaced as a whole where it is written: that it is the same one shows that it was read.
#[cfg(unix)]
fn identity(path: &Path) -> u64 {
    use std::os::unix::fs::MetadataExt;
    fs::metadata(path).expect("an entry").ino()
}

#[test]
fn a_scene_is_read_again() {
    let scratch = Scratch::new("again");
    let fresh = Model::from_source(PENDULUM).expect("a model");
    let first = scratch.cache().from_source(PENDULUM).expect("a model");
    let [entry] = &scratch.entries()[..] else { panic!("one entry") };
    #[cfg(unix)]
    let before = identity(entry);
    let second = scratch.cache().from_source(PENDULUM).expect("a model");
    #[cfg(unix)]
    assert_eq!(identity(entry), before);
    same(&fresh, &first);
    same(&fresh, &second);
    // A mistake is no entry, and is told as without a cache.
    let wrong = PENDULUM.replace("gap =", "gab =");
    let told = scratch.cache().from_source(&wrong).expect_err("a mistake").to_string();
    assert_eq!(told, Model::from_source(&wrong).expect_err("a mistake").to_string());
    assert_eq!(scratch.entries().len(), 1);
}

#[test]
fn what_is_damaged_or_of_another_is_derived_anew() {
    let scratch = Scratch::new("damaged");
    let cache = scratch.cache();
    let fresh = cache.from_source(PENDULUM).expect("a model");
    let entry = scratch.entries().remove(0);
    let whole = fs::read(&entry).expect("an entry");
    for place in (0..whole.len()).step_by(whole.len() / 40) {
        let mut damaged = whole.clone();
        damaged[place] ^= 0x10;
        fs::write(&entry, &damaged).expect("a file");
        same(&fresh, &cache.from_source(PENDULUM).expect("a model"));
        assert_eq!(fs::read(&entry).expect("an entry"), whole, "{place}");
    }
    for part in [&whole[..0], &whole[..20], &whole[..whole.len() - 1]] {
        fs::write(&entry, part).expect("a file");
        same(&fresh, &cache.from_source(PENDULUM).expect("a model"));
    }
    // The entry of another scene, whole, under the name of this one.
    let other = PENDULUM.replace("mass = 2", "mass = 3");
    cache.from_source(&other).expect("a model");
    let own = scratch.entries().into_iter().find(|path| *path != entry).expect("another entry");
    fs::copy(own, &entry).expect("a copy");
    same(&fresh, &cache.from_source(PENDULUM).expect("a model"));
    assert_eq!(fs::read(&entry).expect("an entry"), whole);
}

#[cfg(feature = "urdf")]
#[test]
fn a_file_that_has_changed_is_read_anew() {
    let scratch = Scratch::new("changed");
    let (cache, file) = (scratch.cache(), scratch.0.join("arm.urdf"));
    let mass = |text: &str| {
        fs::write(&file, ROBOT.replace("MASS", text)).expect("a file");
        // What is as new as the derivation is not stored.
        let earlier = std::time::SystemTime::now() - std::time::Duration::from_secs(5);
        fs::File::options().write(true).open(&file).and_then(|file| file.set_modified(earlier)).expect("a time");
        let kernel = cache.from_urdf(&file, &["gravity = 0"]).expect("a model").kernel(&[]).expect("a kernel");
        kernel.mass_matrix(0.0, &[0.3]).expect("a matrix")[0]
    };
    // I + m/4 about the hinge.
    assert!((mass("2") - 0.6).abs() < 1e-15 && scratch.entries().len() == 1);
    assert!((mass("4") - 1.1).abs() < 1e-15 && scratch.entries().len() == 1);
    assert!((mass("4") - 1.1).abs() < 1e-15);
    fs::remove_file(&file).expect("a file");
    assert!(cache.from_urdf(&file, &["gravity = 0"]).is_err());
}

#[test]
fn a_folder_that_cannot_be_written_is_no_mistake() {
    let scratch = Scratch::new("blocked");
    // A file in the place of the folder.
    fs::write(scratch.0.join("cache"), "").expect("a file");
    same(&Model::from_source(PENDULUM).expect("a model"), &scratch.cache().from_source(PENDULUM).expect("a model"));
}

#[test]
fn threads_share_it() {
    let scratch = Scratch::new("threads");
    let models: Vec<Model> = std::thread::scope(|scope| {
        let threads: Vec<_> =
            (0..4).map(|_| scope.spawn(|| scratch.cache().from_source(PENDULUM).expect("a model"))).collect();
        threads.into_iter().map(|thread| thread.join().expect("a thread")).collect()
    });
    models.windows(2).for_each(|pair| same(&pair[0], &pair[1]));
    assert_eq!(scratch.entries().len(), 1);
}
