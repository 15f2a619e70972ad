//! Processes that derive mutations, watched and limited.

use std::io::{BufRead, BufReader};
use std::ops::Range;
use std::process::{Command, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use super::derive::{FAULT, NEXT};

/// Until a derivation hangs: it says itself when it took more than 10 s of a processor, of which it may have a
/// thirtieth where other programs come first. The first of a process gathers the corpus as well.
const PATIENCE: Duration = Duration::from_secs(300);
/// Address space in kilobytes: the gigabyte, and what the program itself and its threads reserve.
const MEMORY: u32 = 1_400_000;

/// Derives some mutations; what is wrong with which.
pub fn derive(mut numbers: Range<u64>) -> Vec<(u64, String)> {
    let mut faults = Vec::new();
    while !numbers.is_empty() {
        match process(numbers.clone(), &mut faults) {
            None => break,
            Some((number, end)) => {
                faults.push((number, end));
                numbers.start = number + 1;
            }
        }
    }
    faults
}

/// One process; where and why it came to an end before all was done.
fn process(numbers: Range<u64>, faults: &mut Vec<(u64, String)>) -> Option<(u64, String)> {
    let program = std::env::current_exe().expect("the test has a file");
    let mut command = if cfg!(unix) { Command::new("sh") } else { Command::new(&program) };
    if cfg!(unix) {
        command.arg("-c").arg(format!("ulimit -v {MEMORY}; exec \"$0\" \"$@\"")).arg(&program);
    }
    command
        .args(["--exact", "no_input_is_too_much", "--nocapture"])
        .envs([("MUTATIONS_FROM", numbers.start.to_string()), ("MUTATIONS_TO", numbers.end.to_string())])
        .stdout(Stdio::piped())
        .stderr(Stdio::null());
    let mut child = command.spawn().expect("a process");
    let lines = BufReader::new(child.stdout.take().expect("it is piped")).lines();
    let (sender, said) = channel();
    thread::spawn(move || lines.map_while(Result::ok).try_for_each(|line| sender.send(line)));
    let (mut at, mut begun, mut derived) = (numbers.start, Instant::now(), 0);
    loop {
        match said.recv_timeout(PATIENCE.saturating_sub(begun.elapsed())) {
            Ok(line) => {
                if let Some(number) = line.strip_prefix(NEXT).and_then(|number| number.parse().ok()) {
                    (at, begun, derived) = (number, Instant::now(), derived + 1);
                } else if let Some(fault) = line.strip_prefix(FAULT) {
                    faults.push((at, fault.to_owned()));
                }
            }
            Err(RecvTimeoutError::Timeout) => {
                child.kill().and_then(|()| child.wait()).expect("it can be killed");
                return Some((at, format!("more than {PATIENCE:?}")));
            }
            Err(RecvTimeoutError::Disconnected) => {
                let status = child.wait().expect("it has ended");
                // A process that finds no test of that name succeeds as well.
                let all = numbers.end - numbers.start;
                let short = || format!("{status} after {derived} of {all}: the stack, or more than a gigabyte");
                return (!status.success() || derived != all).then(|| (at, short()));
            }
        }
    }
}
