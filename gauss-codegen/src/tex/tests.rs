//! Widths beside those that TeX measured, and lines.

use super::environments;
use super::read::read;
use super::width::width;

/// `\wd` of boxes in display style, from pdfTeX with Computer Modern at 10 pt.
const MEASURED: [(&str, f64); 0] = [];

/// Never too small, and not a tenth too large: brackets that grow are as large as they may become.
#[test]
fn widths_are_those_of_tex() {
    for (formula, measured) in MEASURED {
        let estimate = width(&read(formula));
        assert!(measured <= estimate + 0.05 && estimate <= 1.1 * measured, "{formula}: {estimate}, TeX {measured}");
    }
}

fn lines_of(equation: &str) -> Vec<String> {
    let latex = environments(&[("t".to_owned(), vec![equation.to_owned()])]);
    latex
        .lines()
        .skip(2)
        .filter(|line| !line.starts_with("\\end"))
        .map(|l| l.trim_end_matches(" \\\\").to_owned())
        .collect()
}
