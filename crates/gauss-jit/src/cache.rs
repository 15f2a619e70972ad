//! A folder of derivations: a scene or a file that was derived once is read again in milliseconds.
//!
//! An entry has the name of what decides it: the text of the scene, the state of this library, the folder that relative
//! paths begin at. It says which files were read, with a digest of each, and has a digest of itself. What is not as it
//! was written, or is of other files than are there now, is derived anew; programs are verified as those of passes are.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::time::Duration;
use std::time::SystemTime;

use gauss_codegen::program::Program;
use sha2::{Digest, Sha256};

use crate::error::Mistakes;
use crate::model::{Data, Model};

/// The first bytes of an entry.
const BEGINNING: &[u8; 12] = b"gauss model\n";
/// Size of a folder above which the entries that were not read for longest are removed.
const MOST_BYTES: u64 = 256 << 20;
/// End of the names of entries.
const EXTENSION: &str = "gauss";

type Digested = [u8; 32];

/// A folder in which derivations are stored, and from which they are read again.
///
/// Threads and processes share it: an entry is there as a whole or not at all. Where nothing can be written, models are
/// derived each time, as without it. It holds at most 256 MB.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: PathBuf,
}

/// The contents of an entry.
#[derive(serde::Serialize, serde::Deserialize)]
struct Entry {
    /// Its own name: an entry under that of another is none.
    name: String,
    /// Files that were read, with the digest of each.
    files: Vec<(String, Digested)>,
    data: Data,
}

impl Cache {
    /// The cache in a folder, which is made when something is written.
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into() }
    }

    /// The cache of the user who runs the program: in the folder of `GAUSS_CACHE`, or in `gauss` in that of the system
    /// for such files (`XDG_CACHE_HOME`, `~/.cache`, `~/Library/Caches`, `%LOCALAPPDATA%`). None where `GAUSS_CACHE` is
    /// empty or `0`, or nothing says where that would be.
    #[must_use]
    pub fn of_user() -> Option<Self> {
        let named = |name: &str| std::env::var_os(name).filter(|own| !own.is_empty()).map(PathBuf::from);
        if let Some(own) = std::env::var_os("GAUSS_CACHE") {
            return (!own.is_empty() && own != "0").then(|| Self::new(own));
        }
        let of_system = if cfg!(windows) {
            named("LOCALAPPDATA")
        } else if cfg!(target_os = "macos") {
            named("HOME").map(|home| home.join("Library/Caches"))
        } else {
            named("XDG_CACHE_HOME").or_else(|| named("HOME").map(|home| home.join(".cache")))
        };
        of_system.map(|folder| Self::new(folder.join("gauss")))
    }

    /// As [`Model::from_source`].
    ///
    /// # Errors
    /// As of [`Model::from_source`].
    pub fn from_source(&self, source: &str) -> Result<Model, Mistakes> {
        let name = name_of(source);
        let path = self.folder.join(&name).with_extension(EXTENSION);
        if let Some(data) = read(&path, &name) {
            return Ok(Model::of(data));
        }
        let start = SystemTime::now();
        let model = Model::from_source(source)?;
        // A folder that cannot be written is no mistake of the scene.
        let _ = self.write((&path, name), &model.derived.data, start);
        Ok(model)
    }

    /// As [`Model::from_urdf`].
    ///
    /// # Errors
    /// As of [`Model::from_urdf`].
    #[cfg(feature = "urdf")]
    pub fn from_urdf(&self, path: impl AsRef<Path>, clauses: &[&str]) -> Result<Model, Mistakes> {
        self.from_source(&crate::model::of_file("urdf", path.as_ref(), clauses))
    }

    /// As [`Model::from_mjcf`].
    ///
    /// # Errors
    /// As of [`Model::from_mjcf`].
    #[cfg(feature = "mjcf")]
    pub fn from_mjcf(&self, path: impl AsRef<Path>, clauses: &[&str]) -> Result<Model, Mistakes> {
        self.from_source(&crate::model::of_file("mjcf", path.as_ref(), clauses))
    }

    /// Writes an entry, unless a file has changed since the derivation began: which of both was read is not known.
    fn write(&self, (path, name): (&Path, String), data: &Data, start: SystemTime) -> Option<()> {
        let digest = |file: &String| {
            let digest = digest(&fs::read(file).ok()?);
            (changed(file)? < start).then(|| (file.clone(), digest))
        };
        let entry = Entry { name, files: data.files.iter().map(digest).collect::<Option<_>>()?, data: data.clone() };
        let bytes = postcard::to_stdvec(&entry).ok()?;
        fs::create_dir_all(&self.folder).ok()?;
        self.make_room(bytes.len() as u64);
        // Whoever reads finds all of it or nothing.
        let own = path.with_extension(format!("{}.{:?}", std::process::id(), std::thread::current().id()));
        let written = fs::File::create(&own).and_then(|mut file| {
            file.write_all(BEGINNING)?;
            file.write_all(&self::digest(&bytes))?;
            file.write_all(&bytes)
        });
        if written.and_then(|()| fs::rename(&own, path)).is_err() {
            let _ = fs::remove_file(&own);
        }
        Some(())
    }

    /// Removes the entries that were not read for longest, until there is room.
    fn make_room(&self, wanted: u64) {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let entries = entries.filter(|entry| entry.path().extension().is_some_and(|own| own == EXTENSION));
        let known = entries.filter_map(|entry| {
            let about = entry.metadata().ok()?;
            Some((about.modified().ok()?, about.len(), entry.path()))
        });
        let mut known: Vec<_> = known.collect();
        known.sort();
        let mut size = wanted + known.iter().map(|(_, size, _)| size).sum::<u64>();
        for (_, own, path) in known {
            if size <= MOST_BYTES {
                break;
            }
            size -= own;
            let _ = fs::remove_file(path);
        }
    }
}

/// The last time at which a file, or what stands in its place, changed: what is moved there keeps the time at which it
/// was written, and has another of its own where the system tells that.
fn changed(file: &str) -> Option<SystemTime> {
    let about = fs::metadata(file).ok()?;
    let written = about.modified().ok()?;
    #[cfg(unix)]
    let written = {
        use std::os::unix::fs::MetadataExt;
        let since = Duration::new(about.ctime().try_into().ok()?, about.ctime_nsec().try_into().ok()?);
        written.max(SystemTime::UNIX_EPOCH + since)
    };
    Some(written)
}

fn digest(bytes: &[u8]) -> Digested {
    Sha256::digest(bytes).into()
}

/// The name of an entry.
fn name_of(source: &str) -> String {
    let mut hasher = Sha256::new();
    let folder = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).or_else(|| std::env::current_dir().ok());
    let folder = folder.unwrap_or_default();
    for part in [env!("CARGO_PKG_VERSION"), env!("GAUSS_SOURCES"), &folder.to_string_lossy(), source] {
        hasher.update((part.len() as u64).to_le_bytes());
        hasher.update(part);
    }
    hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The derivation of an entry, if it is whole and its files are as they were.
fn read(path: &Path, name: &str) -> Option<Data> {
    // What is no file may never end.
    let bytes = fs::metadata(path).is_ok_and(|about| about.is_file()).then(|| fs::read(path).ok())??;
    let (digested, contents) = bytes.strip_prefix(BEGINNING)?.split_at_checked(size_of::<Digested>())?;
    if digested != digest(contents) {
        return None;
    }
    let Entry { name: own, files, data } = postcard::from_bytes(contents).ok()?;
    let is_same = |(file, own): &(String, Digested)| fs::read(file).is_ok_and(|bytes| digest(&bytes) == *own);
    if !(own == name && files.iter().all(is_same) && data.programs().all(|program| Program::verify(program).is_ok())) {
        return None;
    }
    // The time of the last reading decides what is removed.
    let _ = fs::File::options().write(true).open(path).and_then(|file| file.set_modified(SystemTime::now()));
    Some(data)
}
