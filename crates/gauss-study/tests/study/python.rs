//! The files are read by pyarrow and polars, and SALib finds the same sensitivities: where Python has them.

use std::process::Command;

use crate::common::{Outcome, declaration, failures, waves};
use gauss_study::sensitivity::sobol_indices;
use gauss_study::{Declaration, Plan, fixed, uniform};

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

/// `examples/study/sensitivity.py` finds what [`sobol_indices`] finds.
#[test]
fn salib_finds_the_same_sensitivities() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut declaration = Declaration::new("sum", 3, 4 * 512).plan(Plan::Saltelli);
    let [a, b] = ["a", "b"].map(|name| declaration.parameter(name, "", uniform(-1.0, 2.0)));
    declaration.parameter("c", "", fixed(1.0));
    let y = declaration.number("y", "");
    let study = declaration.study(move |draw, row| {
        row.set(y, draw[a] + 3.0 * draw[b] + draw[a] * draw[b]);
        Ok::<_, String>(())
    })?;
    study.run(folder.path(), |_| ())?;
    let file = study.merge(folder.path())?;
    let ours = sobol_indices(&study.results(folder.path())?.numbers("y")?, 2).ok_or("it varies")?;
    let Some(python) = python("pyarrow, SALib") else { return Ok(()) };
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/study/sensitivity.py");
    let output = Command::new(python).arg(script).arg(file).args(["y", "--json"]).output()?;
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let theirs: serde_json::Value = serde_json::from_slice(&output.stdout)?;
    assert_eq!(theirs["names"], serde_json::json!(["a", "b"]));
    for (n, index) in ours.iter().enumerate() {
        for (name, here) in [("S1", index.first), ("ST", index.total)] {
            let there = theirs[name][n].as_f64().ok_or("a number")?;
            // The same estimators; SALib brings the results to mean 0 and deviation 1 first: some thousand roundings.
            assert!((there - here).abs() < 2048.0 * f64::EPSILON, "{name} of {n}: {here} here, {there} there");
        }
    }
    Ok(())
}
