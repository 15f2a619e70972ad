//! Widths beside those that TeX measured, and lines.

use super::environments;
use super::read::read;
use super::width::width;

/// `\wd` of boxes in display style, from pdfTeX with Computer Modern at 10 pt.
const MEASURED: [(&str, f64); 16] = [
    ("m \\, l^{2} \\, \\ddot{\\theta}", 24.8),
    ("\\left(I_{1} - I_{2}\\right) \\, \\dot{\\varphi} \\, \\sin^{2} \\vartheta", 75.3),
    ("\\frac{d}{dt} p_{\\mathit{shoulder}}", 47.5),
    ("\\frac{k \\, x \\, \\mathit{stretch}}{\\sqrt{x^{2} + y^{2}}}", 46.5),
    ("\\left(2 \\, \\left(\\frac{I_{22,\\mathit{one}}}{2} + m_{2}\\right) + I_{1}\\right) \\, \\dot{a}", 123.8),
    ("\\operatorname{atan2}\\left(x, y\\right)", 49.3),
    (
        "-m_{\\mathit{three}} \\, c_{3,\\mathit{three}} \\, l_{1} \\, \\dot{a} \\, \\sin a \\, \\cos\\left(a + b + c\\right)",
        168.7,
    ),
    ("6.25 \\cdot 10^{-12} \\, \\mathit{mass\\_of}", 87.6),
    ("\\left|\\Omega_{1}\\right|^{3} \\, \\exp\\left(-\\lambda \\, t\\right)", 68.7),
    ("f''\\left(x\\right) + \\hat{\\Gamma}_{2}", 49.2),
    ("\\frac{\\frac{a}{b} + c}{1 + \\frac{x}{m}}", 29.1),
    ("x^{n_{1}} + \\left(1 + x^{2}\\right)^{n}", 69.3),
    ("\\text{left out of what TeX sets}", 109.6),
    (
        "b_{1} \\, \\left(m \\, \\left(\\hat{\\omega}_{1} \\, \\left(\\hat{\\xi}_{2} + b_{1} \\, \\hat{\\omega}_{3}\\right)\\right) - R_{31} \\, f\\right)",
        152.3,
    ),
    ("\\dot{\\mathit{RH\\_HFE}} \\, \\cos \\mathit{RH\\_HFE} \\, s_{74} - \\sin \\mathit{RH\\_HFE} \\, s_{180}", 203.9),
    (
        "\\dot{b} \\, \\sin a \\, \\sin b \\, \\cos \\theta + \\dot{\\theta} \\, \\sin a \\, \\cos b \\, \\sin \\theta",
        156.5,
    ),
];

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

/// Width of a line as it is set: the part before `&` ends where the part after it begins.
fn width_of_line(line: &str) -> f64 {
    let (left, right) = line.split_once('&').expect("an alignment");
    // Brackets of a fixed size are no pair for the reader, which takes them for symbols of the widest letter.
    width(&read(left)) + width(&read(&right.replace("\\quad", "\\,\\,\\,\\,\\,\\,")))
}

#[test]
fn short_equations_stay_in_one_line() {
    assert_eq!(lines_of("F_{x} = -k \\, x + a"), ["F_{x} &= -k \\, x + a"]);
    assert_eq!(lines_of("a + b = c"), ["& a + b = c"]);
}

#[test]
fn sums_break_at_signs_into_lines_of_like_length() {
    let terms: Vec<String> = (0..24).map(|k| format!("m_{{{k}}} \\, \\dot{{x}}_{{{k}}}")).collect();
    let lines = lines_of(&format!("p = {}", terms.join(" + ")));
    assert!(lines.len() > 1);
    for line in &lines[1..] {
        assert!(line.starts_with("&\\quad + m_"), "{line}");
    }
    let widths: Vec<f64> = lines.iter().map(|line| width_of_line(line)).collect();
    let [least, most] = [f64::min, f64::max].map(|of| widths.iter().copied().reduce(of).expect("a line"));
    // A term is 30 pt wide.
    assert!(most - least < 60.0 && most < 456.0, "{widths:?}");
}

/// Brackets, fractions, roots and products of such, several times as long as a line.
#[test]
fn whatever_is_long_is_broken_inside() {
    let long = |letter: &str| (0..40).map(|k| format!("{letter}_{{{k}}}")).collect::<Vec<_>>().join(" - ");
    let (a, b) = (long("a"), long("b"));
    let cases = [
        format!("m \\, \\left({a}\\right) \\, \\left({b}\\right)^{{2}} + c"),
        format!("\\frac{{\\left({a}\\right) \\, \\cos x}}{{k}} - \\frac{{c}}{{{b}}}"),
        format!("\\frac{{{a}}}{{{b}}}"),
        format!("\\sqrt{{{a}}} + \\sqrt{{{b}}}^{{3}}"),
        format!("\\left|{a}\\right| \\, \\sin\\left({b}\\right)"),
        format!("\\left(x + \\left({a}\\right) \\, \\left(y - \\left({b}\\right)\\right)\\right)"),
        format!("\\operatorname{{atan2}}\\left({a}, {b}\\right)"),
        format!("\\frac{{\\left({a}\\right) \\, \\left({b}\\right)}}{{{a}}}"),
        "x \\, ".repeat(200) + "y",
    ];
    for case in cases {
        let lines = lines_of(&format!("p = {case}"));
        assert!(lines.len() > 2, "{case}");
        let all = lines.concat();
        let count = |text: &str| all.matches(text).count();
        assert_eq!(count("{"), count("}"), "{all}");
        assert_eq!(count("\\left"), count("\\right"), "{all}");
        assert_eq!(count("bigl"), count("bigr"), "{all}");
        for line in &lines {
            // In no line a brace stays open.
            let count = |text: &str| line.matches(text).count();
            assert_eq!((count("{"), count("\\left")), (count("}"), count("\\right")), "{line}");
            assert!(width_of_line(line) < 480.0, "{}: {line}", width_of_line(line));
        }
    }
}

/// Names and words that nothing can break, and what is no LaTeX, are set as they are.
#[test]
fn nothing_is_lost_of_what_cannot_be_broken() {
    let name = format!("\\mathit{{{}}}", "w".repeat(100));
    assert!(lines_of(&format!("p = {name} + {name}")).concat().matches(&name).count() == 2);
    for broken in [
        "{x",
        "\\mathit{\\é}",
        "\\text{é\\",
        "\\frac{1",
        "\\left(x",
        "x_",
        "\\",
        "\\text{a",
        "}",
        "x^^2",
        "\\mathit",
        "\\left",
    ] {
        assert!(lines_of(&format!("p = {broken}")).concat().contains(broken), "{broken}");
        assert!(lines_of(&format!("p = {}{broken}", "a + ".repeat(100))).concat().contains(broken), "{broken}");
    }
}

#[test]
fn headings_break_between_words() {
    let title = format!("{}momenta $p = \\partial T/\\partial z$", "words of a heading ".repeat(8));
    let latex = environments(&[(title, Vec::new())]);
    assert!(latex.lines().count() > 3 && latex.contains("$p = \\partial T/\\partial z$"), "{latex}");
}
