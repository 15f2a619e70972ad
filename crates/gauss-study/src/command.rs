//! The command line of a study: `run`, `status`, `merge`, `show`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use lexopt::prelude::*;

use crate::row::Value;
use crate::study::{Progress, Shard, Study};

const HELP: &str = "\
run [--shard k/N] [--threads T] --out DIR   makes the runs that DIR lacks; worker k of N, from 1
status DIR                                  how far it is; ends with 1 while runs are missing
merge DIR                                   all parts as one file, DIR/study.parquet
show RUN                                    parameters and results of one run
";

/// The command that stands on the command line.
#[derive(Debug, PartialEq)]
enum Command {
    Run { shard: Shard, threads: usize, folder: PathBuf },
    Status(PathBuf),
    Merge(PathBuf),
    Show(u64),
    Help,
}

/// A study as a command: `main` of a program that is nothing else.
///
/// ```text
/// study run [--shard k/N] [--threads T] --out DIR
/// study status DIR
/// study merge DIR
/// study show RUN
/// ```
///
/// The exit code is 0 where all is done, 1 of `status` while runs are missing, 2 of an error, which is told on the
/// standard error, as is progress.
pub fn main(study: &Study<'_>) -> ExitCode {
    main_from(study, std::env::args_os().skip(1))
}

/// The same with arguments that stand elsewhere.
pub fn main_from(study: &Study<'_>, arguments: impl IntoIterator<Item = std::ffi::OsString>) -> ExitCode {
    let done = parse(lexopt::Parser::from_args(arguments)).map_err(|error| format!("{error}\n{HELP}"));
    match done.and_then(|command| obey(study, command)) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn parse(mut parser: lexopt::Parser) -> Result<Command, lexopt::Error> {
    let (mut words, mut shard, mut threads, mut folder) = (Vec::new(), Shard::WHOLE, 0, None);
    while let Some(argument) = parser.next()? {
        match argument {
            Long("shard") => shard = parser.value()?.parse_with(shard_of)?,
            Long("threads") => threads = parser.value()?.parse()?,
            Long("out") => folder = Some(PathBuf::from(parser.value()?)),
            Long("help") | Short('h') => return Ok(Command::Help),
            Value(word) => words.push(word),
            other => return Err(other.unexpected()),
        }
    }
    let named = words.first().and_then(|word| word.to_str());
    match (named, &words.get(1..).unwrap_or_default(), folder) {
        (Some("run"), [], Some(folder)) => Ok(Command::Run { shard, threads, folder }),
        (Some("run"), [], None) => Err("`run` needs `--out DIR`".into()),
        (Some("status"), [folder], None) => Ok(Command::Status(folder.into())),
        (Some("merge"), [folder], None) => Ok(Command::Merge(folder.into())),
        (Some("show"), [run], None) => Ok(Command::Show(run.parse()?)),
        _ => Err("there is no such command".into()),
    }
}

fn shard_of(text: &str) -> Result<Shard, String> {
    let numbers = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
    numbers.and_then(|(k, n)| Shard::new(k, n)).ok_or_else(|| "a shard is k/N with k from 1 to N".to_owned())
}

fn obey(study: &Study<'_>, command: Command) -> Result<ExitCode, String> {
    let words = |error: crate::StudyError| error.to_string();
    match command {
        Command::Help => print!("{HELP}"),
        Command::Run { shard, threads, folder } => {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|e| e.to_string())?;
            let bar = Bar::new();
            let end = pool.install(|| study.run_shard(&folder, shard, |now| bar.show(now))).map_err(words)?;
            println!("{}", line(end));
        }
        Command::Status(folder) => {
            let now = study.status(&folder).map_err(words)?;
            println!("{}: {}", study.name(), line(now));
            return Ok(ExitCode::from(u8::from(now.runs < now.of)));
        }
        Command::Merge(folder) => println!("{}", study.merge(&folder).map_err(words)?.display()),
        Command::Show(run) => show(study, run)?,
    }
    Ok(ExitCode::SUCCESS)
}

fn show(study: &Study<'_>, run: u64) -> Result<(), String> {
    let declaration = study.declaration();
    if run >= declaration.runs {
        return Err(format!("run {run}: runs are from 0 to {}", declaration.runs - 1));
    }
    let (sample, row) = study.one(run);
    for (parameter, value) in declaration.parameters.iter().zip(sample.values()) {
        println!("{} = {value} {}", parameter.name, parameter.unit);
    }
    for (column, value) in declaration.columns.iter().zip(&row.values) {
        match value {
            Some(value) => println!("{} = {} {}", column.name, text(value), column.unit),
            None => println!("{}: none", column.name),
        }
    }
    row.cause().iter().for_each(|cause| println!("failed: {cause}"));
    Ok(())
}

fn text(value: &crate::row::Value) -> String {
    match value {
        Value::Number(number) => number.to_string(),
        Value::Integer(number) => number.to_string(),
        Value::Flag(flag) => flag.to_string(),
        Value::Text(text) => text.clone(),
    }
}

fn line(Progress { runs, of, failed, damaged }: Progress) -> String {
    let damaged = if damaged > 0 { format!(", {damaged} damaged parts made anew") } else { String::new() };
    format!("{runs} of {of} runs, {failed} failed{damaged}")
}

/// A line on the standard error every two seconds, which logs of batch systems keep.
struct Bar {
    begun: Instant,
    /// When the last line was written, and how many runs there were at the beginning.
    last: Mutex<(Option<Instant>, u64)>,
}

impl Bar {
    fn new() -> Self {
        Self { begun: Instant::now(), last: Mutex::new((None, 0)) }
    }

    fn show(&self, now: Progress) {
        let Ok(mut last) = self.last.lock() else { return };
        if last.0.is_none() {
            last.1 = now.runs;
        } else if now.runs < now.of && last.0.is_some_and(|last| last.elapsed() < Duration::from_secs(2)) {
            return;
        }
        last.0 = Some(Instant::now());
        let seconds = self.begun.elapsed().as_secs_f64();
        let rate = (now.runs - last.1) as f64 / seconds.max(1e-9);
        eprintln!("{seconds:8.1} s  {}, {rate:.0} runs/s", line(now));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Command, String> {
        parse(lexopt::Parser::from_args(line.split_whitespace())).map_err(|error| error.to_string())
    }

    #[test]
    fn lines_are_read() -> Result<(), String> {
        let run = |number, of, threads| {
            let shard = Shard::new(number, of).unwrap_or(Shard::WHOLE);
            Command::Run { shard, threads, folder: "a".into() }
        };
        assert_eq!(parsed("run --out a")?, run(1, 1, 0));
        assert_eq!(parsed("run --shard=3/7 --threads 2 --out a")?, run(3, 7, 2));
        assert_eq!(parsed("status a")?, Command::Status("a".into()));
        assert_eq!(parsed("merge a")?, Command::Merge("a".into()));
        assert_eq!(parsed("show 12")?, Command::Show(12));
        assert_eq!(parsed("run --help")?, Command::Help);
        Ok(())
    }

    #[test]
    fn lines_that_say_nothing_are_refused() {
        for (line, word) in [
            ("", "no such command"),
            ("runs", "no such command"),
            ("merge", "no such command"),
            ("merge a b", "no such command"),
            ("run", "--out"),
            ("run --shard 0/7 --out a", "from 1 to N"),
            ("run --shard 8/7 --out a", "from 1 to N"),
            ("run --shard 1 --out a", "k/N"),
            ("run --threads many --out a", "many"),
            ("show -3", "-3"),
            ("status a --fast", "--fast"),
        ] {
            let error = parsed(line).expect_err(line);
            assert!(error.contains(word), "{line}: {error}");
        }
    }
}
