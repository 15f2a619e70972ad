//! Files of expansions that are kept, and whether they still hold.

use std::env;
use std::fs::{self, File};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use super::tokens::{Bytes, Output};

/// Beyond this, what was not used for the longest time is removed.
const MOST_BYTES: u64 = 256 << 20;

/// Span by which a change of a file may seem earlier than it was: file systems look at the clock a few hundred times a
/// second.
const CLOCK: Duration = Duration::from_millis(10);

/// A folder of expansions, each a file that is named by a hash of what it depends on and says all of it.
pub struct Store {
    folder: PathBuf,
    /// Dependencies of every expansion of this build: the macro and the package.
    build: Vec<u8>,
}

impl Store {
    /// None where the compiler keeps nothing itself, and where the library of the macro is not found.
    pub fn of_this_build() -> Option<Self> {
        let arguments: Vec<String> =
            env::args_os().map(|argument| argument.into_string().ok()).collect::<Option<_>>()?;
        let incremental = values(&arguments, "-C", "--codegen").find_map(|value| value.strip_prefix("incremental="))?;
        let mut build = Output::default();
        build.bytes(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default().as_encoded_bytes());
        for library in libraries(&arguments) {
            let about = fs::metadata(&library).ok()?;
            build.bytes(library.as_os_str().as_encoded_bytes());
            build.number(about.len());
            build.bytes(format!("{:?}", about.modified().ok()?).as_bytes());
        }
        let folder = Path::new(incremental).parent()?.join("gauss-derive");
        (!libraries(&arguments).is_empty()).then_some(Self { folder, build: build.0 })
    }

    /// The bytes kept under a key, if they are whole and every file is as it was.
    pub fn find(&self, key: &[u8]) -> Option<Vec<u8>> {
        let path = self.path(key);
        let whole = fs::read(&path).ok()?;
        let mut rest = Bytes(&whole);
        let sum = rest.number()?;
        if sum != hash(rest.0) || rest.bytes()? != self.build || rest.bytes()? != key {
            return None;
        }
        for _ in 0..rest.number()? {
            let (file, content) = (rest.text()?, rest.bytes()?);
            if about(Path::new(file)).ok()? != content {
                return None;
            }
        }
        let bytes = rest.bytes()?.to_owned();
        // What is used stays.
        let _ = File::options().append(true).open(path).and_then(|file| file.set_modified(SystemTime::now()));
        rest.0.is_empty().then_some(bytes)
    }

    /// Keeps bytes under a key, as long as `files` stay what they were when they were read, at `begin` or later.
    ///
    /// # Errors
    /// What reading and writing say; nothing is kept. [`io::ErrorKind::Interrupted`] where a file was written to since
    /// `begin`: what was read of it may be older than what it has now.
    pub fn keep(&self, key: &[u8], bytes: &[u8], files: &[String], begin: SystemTime) -> io::Result<()> {
        let mut rest = Output::default();
        rest.bytes(&self.build);
        rest.bytes(key);
        rest.number(files.len() as u64);
        for file in files {
            rest.bytes(file.as_bytes());
            if fs::metadata(file)?.modified()? + CLOCK >= begin {
                return Err(io::ErrorKind::Interrupted.into());
            }
            rest.bytes(&about(Path::new(file))?);
        }
        rest.bytes(bytes);
        let mut whole = Output::default();
        whole.number(hash(&rest.0));
        whole.0.extend(rest.0);

        fs::create_dir_all(&self.folder)?;
        self.make_room(whole.0.len() as u64)?;
        // Whoever reads finds all or nothing, also while several crates are compiled at once.
        let path = self.path(key);
        let part = path.with_extension(std::process::id().to_string());
        fs::write(&part, &whole.0)?;
        fs::rename(part, path)
    }

    fn path(&self, key: &[u8]) -> PathBuf {
        self.folder.join(format!("{:016x}{:016x}", hash(&(&self.build, key, 0)), hash(&(&self.build, key, 1))))
    }

    fn make_room(&self, size: u64) -> io::Result<()> {
        let mut files = Vec::new();
        for entry in fs::read_dir(&self.folder)? {
            let entry = entry?;
            let about = entry.metadata()?;
            files.push((about.modified()?, about.len(), entry.path()));
        }
        files.sort_unstable();
        let mut all = files.iter().map(|(_, length, _)| length).sum::<u64>() + size;
        for (_, length, path) in files {
            if all <= MOST_BYTES {
                break;
            }
            fs::remove_file(path)?;
            all -= length;
        }
        Ok(())
    }
}

/// Content of a file by its length and hashes.
fn about(file: &Path) -> io::Result<Vec<u8>> {
    let content = fs::read(file)?;
    let mut about = Output::default();
    for number in [content.len() as u64, hash(&(&content, 0)), hash(&(&content, 1))] {
        about.number(number);
    }
    Ok(about.0)
}

fn hash(what: &(impl Hash + ?Sized)) -> u64 {
    let mut hasher = DefaultHasher::new();
    what.hash(&mut hasher);
    hasher.finish()
}

/// The values of an option of the compiler, behind its short name or its long one.
fn values<'a>(arguments: &'a [String], short: &'a str, long: &'a str) -> impl Iterator<Item = &'a str> {
    arguments.iter().enumerate().filter_map(move |(k, argument)| {
        let following = || arguments.get(k + 1).map(String::as_str);
        if argument == short || argument == long {
            return following();
        }
        let joined = argument.strip_prefix(long).and_then(|rest| rest.strip_prefix('='));
        joined.or_else(|| argument.strip_prefix(short))
    })
}

/// Every library of this macro that the compiler may have loaded, in the order of their names.
fn libraries(arguments: &[String]) -> Vec<PathBuf> {
    let folders = values(arguments, "-L", "-L").map(|value| value.rsplit_once('=').map_or(value, |(_, folder)| folder));
    let mut found: Vec<PathBuf> = folders
        .filter_map(|folder| fs::read_dir(folder).ok())
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.path()))
        .collect();
    found.extend(
        values(arguments, "--extern", "--extern").filter_map(|value| Some(PathBuf::from(value.split_once('=')?.1))),
    );
    found.retain(|path| {
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        path.extension().is_some_and(|extension| extension == env::consts::DLL_EXTENSION)
            && stem.trim_start_matches(env::consts::DLL_PREFIX).starts_with(env!("CARGO_CRATE_NAME"))
    });
    found.sort_unstable();
    found.dedup();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// When a derivation would begin that reads files as they are now.
    fn soon() -> SystemTime {
        SystemTime::now() + Duration::from_secs(1)
    }

    fn store(name: &str) -> Store {
        let folder = env::temp_dir().join(format!("gauss-derive-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        Store { folder, build: b"a build".to_vec() }
    }

    #[test]
    fn what_is_kept_is_found_while_files_stay() {
        let mut store = store("found");
        assert_eq!(store.find(b"key"), None);
        fs::create_dir_all(&store.folder).unwrap();
        let file = store.folder.with_extension("urdf");
        fs::write(&file, "a robot").unwrap();
        let files = [file.to_str().unwrap().to_owned()];
        store.keep(b"key", b"code", &files, soon()).unwrap();
        assert_eq!(store.find(b"key").as_deref(), Some(&b"code"[..]));
        assert_eq!(store.find(b"other"), None);

        fs::write(&file, "a rowboat").unwrap();
        assert_eq!(store.find(b"key"), None);
        fs::remove_file(&file).unwrap();
        assert_eq!(store.find(b"key"), None);
        assert!(store.keep(b"key", b"code", &files, soon()).is_err());

        // Written to while the code was derived: of which content is it?
        let begin = SystemTime::now();
        fs::write(&file, "a boat").unwrap();
        assert!(store.keep(b"key", b"code", &files, begin).is_err());
        assert_eq!(store.find(b"key"), None);

        store.keep(b"key", b"code", &[], soon()).unwrap();
        store.build = b"another build".to_vec();
        assert_eq!(store.find(b"key"), None);
        fs::remove_dir_all(store.folder).unwrap();
    }

    #[test]
    fn bytes_that_are_not_whole_are_not_read() {
        let store = store("whole");
        store.keep(b"key", b"some code", &[], soon()).unwrap();
        let path = store.path(b"key");
        let whole = fs::read(&path).unwrap();
        for length in 0..whole.len() {
            fs::write(&path, &whole[..length]).unwrap();
            assert_eq!(store.find(b"key"), None, "{length} bytes");
            let mut wrong = whole.clone();
            wrong[length] ^= 1;
            fs::write(&path, wrong).unwrap();
            assert_eq!(store.find(b"key"), None, "byte {length}");
        }
        fs::write(&path, [&whole[..], &[0]].concat()).unwrap();
        assert_eq!(store.find(b"key"), None);
        fs::remove_dir_all(store.folder).unwrap();
    }

    #[test]
    fn what_was_not_used_for_longest_goes_first() {
        let store = store("room");
        for (key, age) in [(b"a", 3), (b"b", 1), (b"c", 2)] {
            store.keep(key, b"code", &[], soon()).unwrap();
            let file = File::options().append(true).open(store.path(key)).unwrap();
            file.set_modified(SystemTime::now() - Duration::from_secs(age)).unwrap();
        }
        // As if the next one were as large as all that is allowed but for one file.
        let one = fs::metadata(store.path(b"a")).unwrap().len();
        store.make_room(MOST_BYTES - one).unwrap();
        let there = [b"a", b"b", b"c"].map(|key| store.find(key).is_some());
        assert_eq!(there, [false, true, false]);
        fs::remove_dir_all(store.folder).unwrap();
    }

    #[test]
    fn options_of_the_compiler_are_read_in_every_form() {
        let line = |words: &str| words.split(' ').map(str::to_owned).collect::<Vec<_>>();
        for words in
            ["-C incremental=here", "-Cincremental=here", "--codegen incremental=here", "--codegen=incremental=here"]
        {
            let arguments = line(&format!("rustc {words} --edition=2024"));
            let found: Vec<&str> = values(&arguments, "-C", "--codegen").collect();
            assert_eq!(found, ["incremental=here"], "{words}");
        }
        assert_eq!(values(&line("rustc -C"), "-C", "--codegen").count(), 0);
    }
}
