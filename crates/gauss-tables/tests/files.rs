//! Tables written, and read again by the crates that others read them with.

use std::error::Error;
use std::fs;

use gauss_runtime::prelude::*;
use gauss_tables::{RunTable, Table, TableError, Tabulate};

/// A top: a rotation, quasi-velocities and energies, so that units are known.
#[derive(GaussDynamics)]
#[gauss(chart = left_invariant, motion = fixed_point)]
struct Top {
    #[gauss(mass)]
    mass: f64,
    #[gauss(center_of_mass)]
    center: Vector3<f64>,
    #[gauss(inertia)]
    inertia: Vector3<f64>,
    #[gauss(gravity)]
    gravity: f64,
}

/// Numbers whose decimals are long, and some that are none.
fn table() -> Result<RunTable<TopKernel>, Box<dyn Error>> {
    let (center, inertia) = (Vector3::new(0.0, 0.0, 0.1), Vector3::new(0.2, 0.2, 0.1));
    let kernel = Top { mass: 1.0, center, inertia, gravity: 9.81 }.kernel()?;
    let start = UnitQuaternion::from_euler_angles(0.5, 0.0, 0.0);
    let run = Simulation::new(&kernel).fixed_step(0.01).run(start, Vector3::new(0.0, 0.0, 30.0), 0.0..1.0)?;
    let table = run.table().state().energies(&kernel).column("inverse, \"raw\"", |s| 1.0 / s.t);
    Ok(table.si().units([("inverse, \"raw\"", "1/s")])?)
}

const UNITS: [Option<&str>; 12] = {
    let (one, rate, energy) = (Some("1"), Some("rad/s"), Some("J"));
    [Some("s"), one, one, one, one, rate, rate, rate, energy, energy, energy, Some("1/s")]
};

#[test]
fn csv_reads_back() -> Result<(), Box<dyn Error>> {
    let (table, folder) = (table()?, std::env::temp_dir().join(format!("gauss_tables_{}", std::process::id())));
    let file = folder.join("deeper/top.csv");
    table.write_csv(&file)?;
    let mut reader = csv::Reader::from_path(&file)?;
    let headings: Vec<String> = reader.headers()?.iter().map(str::to_owned).collect();
    assert_eq!(headings[..2], ["t / s", "rotation_i / 1"]);
    assert_eq!(
        headings[5..],
        [
            "omega_x / (rad/s)",
            "omega_y / (rad/s)",
            "omega_z / (rad/s)",
            "kinetic energy / J",
            "potential energy / J",
            "energy / J",
            "inverse, \"raw\" / (1/s)"
        ]
    );
    let rows: Vec<Vec<f64>> = reader.deserialize().collect::<Result<_, _>>()?;
    assert_eq!(rows.len(), table.samples().len());
    for (n, column) in table.iter().enumerate() {
        assert!(rows.iter().zip(column.values).all(|(row, value)| row[n] == *value), "{column}");
    }
    // A file stands where a folder should be.
    let error = table.write_csv(file.join("below.csv")).expect_err("no folder");
    assert!(matches!(error, TableError::Io { .. }) && error.to_string().contains("below.csv"), "{error}");
    fs::remove_dir_all(folder)?;
    assert_eq!(table.iter().map(|column| column.unit).collect::<Vec<_>>(), UNITS);
    Ok(())
}

#[cfg(feature = "plot")]
#[test]
fn a_panel_for_each_unit() -> Result<(), Box<dyn Error>> {
    let table = table()?;
    let svg = table.svg()?;
    // Names of what shares a panel, units and single names at axes.
    for word in ["rotation_i", "kinetic energy", "rad/s", "J", "t / s", "inverse, &quot;raw&quot;", "1/s"] {
        assert!(svg.contains(&format!("\n{word}\n")), "{word}");
    }
    let curves = svg.matches("stroke-width=\"16\"").count();
    // Each with a stroke beside its name: the one that is alone has a name too long for the axis.
    assert_eq!(curves, 11 * 2);
    assert!(matches!(table.plot("top.png"), Err(TableError::NotSvg(_))));

    // Panels that are asked for, and no others; those that need two axes are refused.
    let chosen = table.clone().panel(["energy"])?.panel(["omega_z", "omega_x"])?.svg()?;
    let curves = chosen.matches("stroke-width=\"16\"").count();
    assert!(curves == 1 + 2 * 2 && !chosen.contains("rotation_i") && chosen.contains("\nenergy / J\n"), "{curves}");
    let mixed = table.clone().panel(["energy", "omega_x"])?.svg().expect_err("two units");
    assert_eq!(
        mixed.to_string(),
        "a panel has one axis, and these columns have several units: energy / J, omega_x / (rad/s)"
    );
    let few = table.clone().select(["t", "energy"])?.svg()?;
    assert_eq!(few.matches("stroke-width=\"16\"").count(), 1);
    let few = Table::new(table.samples()[..1].to_vec()).column("angle", |s| s.z[0]);
    assert!(matches!(few.svg(), Err(TableError::NothingToPlot)));
    assert!(matches!(Table::new(table.samples().to_vec()).svg(), Err(TableError::NothingToPlot)));
    Ok(())
}

/// Points are discs in the place of a line, in the plot and beside the name; nothing else changes.
#[cfg(feature = "plot")]
#[test]
fn points_without_lines() -> Result<(), Box<dyn Error>> {
    // Rows in no order of x, at places of their own, and one that cannot be drawn.
    let x: Vec<f64> = (0..300).map(|n| f64::from(n * 131 % 300)).collect();
    let mut y: Vec<f64> = x.iter().map(|x| (0.05 * x).sin()).collect();
    y[7] = f64::NAN;
    let model = x.iter().map(|x| 0.001 * x).collect();
    let table =
        Table::from_columns([("x", x), ("seen", y), ("model", model)])?.units([("seen", "m"), ("model", "m")])?;
    let counts = |svg: &str| (svg.matches("<circle").count(), svg.matches("stroke-width=\"16\"").count());
    // Curves with a stroke beside their names; one of them in two pieces around what cannot be drawn.
    assert_eq!(counts(&table.svg()?), (0, 3 + 2));
    let cloud = table.clone().points(["seen"])?;
    assert_eq!(counts(&cloud.svg()?), (299 + 1, 2));
    assert!(cloud.svg()?.contains("\nseen\n"));
    // The choice stays with the column, whatever is done to the table; files have no trace of it.
    assert_eq!(counts(&cloud.clone().select(["model", "seen"])?.svg()?).0, 299);
    assert_eq!(counts(&cloud.clone().panel(["model"])?.svg()?).0, 0);
    assert_eq!(cloud.to_string(), table.to_string());
    assert_eq!(table.points(["sen", "x"]).expect_err("no such column").to_string(), "the table has no column `sen`");
    Ok(())
}

/// What a record batch has: names, units, numbers bit by bit.
#[cfg(feature = "arrow")]
fn is_same(table: &RunTable<TopKernel>, batches: &[arrow_array::RecordBatch]) {
    use arrow_array::cast::AsArray;
    use arrow_array::types::Float64Type;
    let [batch] = batches else { panic!("one batch") };
    let schema = batch.schema();
    for (n, column) in table.iter().enumerate() {
        let field = schema.field(n);
        assert_eq!((field.name().as_str(), field.metadata().get("unit").map(String::as_str)), (column.name, UNITS[n]));
        assert!(!field.is_nullable() && batch.column(n).as_primitive::<Float64Type>().values() == column.values);
    }
}

#[cfg(feature = "arrow")]
#[test]
fn arrow_reads_back() -> Result<(), Box<dyn Error>> {
    let (table, file) = (table()?, std::env::temp_dir().join(format!("gauss_tables_{}.arrow", std::process::id())));
    table.write_arrow(&file)?;
    let reader = arrow_ipc::reader::FileReader::try_new(fs::File::open(&file)?, None)?;
    is_same(&table, &reader.collect::<Result<Vec<_>, _>>()?);
    fs::remove_file(file)?;
    Ok(())
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_reads_back() -> Result<(), Box<dyn Error>> {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;
    let (table, file) = (table()?, std::env::temp_dir().join(format!("gauss_tables_{}.parquet", std::process::id())));
    table.write_parquet(&file)?;
    let reader = SerializedFileReader::new(fs::File::open(&file)?)?;
    let metadata = reader.metadata().file_metadata();
    let names: Vec<_> = metadata.schema_descr().columns().iter().map(|column| column.name().to_owned()).collect();
    assert_eq!(names, table.names().collect::<Vec<_>>());
    let units = metadata.key_value_metadata().expect("there are units");
    for column in table.iter() {
        let unit = units.iter().find(|pair| pair.key == format!("unit:{}", column.name));
        assert_eq!(unit.and_then(|pair| pair.value.as_deref()), column.unit, "{column}");
    }
    let mut rows = 0;
    for (n, row) in reader.get_row_iter(None)?.enumerate() {
        let row = row?;
        for (k, column) in table.iter().enumerate() {
            assert_eq!(row.get_double(k)?.to_bits(), column.values[n].to_bits(), "{column}");
        }
        rows += 1;
    }
    assert_eq!(rows, table.len());
    fs::remove_file(file)?;
    Ok(())
}
