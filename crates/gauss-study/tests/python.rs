//! The files are read by pyarrow and polars, and SALib finds the same sensitivities: where Python has them.

mod common;

use std::process::Command;

use common::{Outcome, declaration, failures, waves};

const READ: &str = r#"
import json, sys
import polars, pyarrow.dataset, pyarrow.parquet
folder, failures = sys.argv[1], int(sys.argv[2])
table = pyarrow.parquet.read_table(folder + "/study.parquet")
assert table.num_rows == 1000, table.num_rows
assert table.column_names == ["seed", "run", "length", "height", "kind", "speed", "breaks_at", "crests", "steep", "word", "cause"]
types = [str(field.type) for field in table.schema]
assert types == ["uint64", "uint64"] + 5 * ["double"] + ["int64", "bool", "string", "string"], types
assert set(table["seed"].to_pylist()) == {2**64 - 1}
assert table["run"].to_pylist() == list(range(1000))
assert 1000 - table["cause"].null_count == failures
kept = json.loads(table.schema.metadata[b"gauss_study"])
assert kept["parameters"][0]["unit"] == "m" and kept["seed"] == 2**64 - 1
frame = polars.read_parquet(folder + "/study.parquet")
assert frame.to_arrow().cast(table.schema).equals(table.replace_schema_metadata(None))
assert polars.scan_parquet(folder + "/part-*.parquet").collect().equals(frame)
parts = sorted(pyarrow.dataset.dataset([p for p in __import__("glob").glob(folder + "/part-*.parquet")]).to_table()["run"].to_pylist())
assert parts == list(range(1000))
assert frame["length"].min() >= 1 and frame["length"].max() <= 3
print("read")
"#;

/// The interpreter named in `GAUSS_PYTHON`, or `python3`, if it has these modules.
fn python(modules: &str) -> Option<String> {
    let python = std::env::var("GAUSS_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let there = Command::new(&python).args(["-c", &format!("import {modules}")]).output();
    let there = there.is_ok_and(|output| output.status.success());
    if !there {
        println!("not tested: {python} has not {modules}");
    }
    there.then_some(python)
}

#[test]
fn pyarrow_and_polars_read_the_files() -> Outcome {
    let folder = tempfile::tempdir()?;
    let study = waves(declaration(u64::MAX))?;
    study.run(folder.path(), |_| ())?;
    study.merge(folder.path())?;
    let Some(python) = python("pyarrow, polars") else { return Ok(()) };
    let path = folder.path().display().to_string();
    let output = Command::new(python).args(["-c", READ, &path, &failures().to_string()]).output()?;
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && output.stdout.starts_with(b"read"), "{words}");
    Ok(())
}
