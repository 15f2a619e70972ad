//! Equations set by TeX itself, where it is installed, on pages whose text is 16 cm wide.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// Sets all of it in one document, each environment under its title; says what TeX complains of. `None`, with the
/// reason printed, where there is no TeX.
pub fn complaints(name: &str, equations: &[(String, String)]) -> Option<String> {
    if Command::new("pdflatex").arg("--version").output().is_err() {
        eprintln!("skipped: there is no `pdflatex` here, so the structure of LaTeX is all that was looked at");
        return None;
    }
    let mut document = String::from(
        "\\documentclass{article}\n\\usepackage{amsmath}\n\\usepackage[paperwidth=20cm,paperheight=60cm,textwidth=16cm]{geometry}\n\
         \\allowdisplaybreaks\n\\setlength{\\parindent}{0pt}\n\\begin{document}\n",
    );
    // The font of titles has letters of ASCII alone.
    let ascii = |title: &str| title.replace(|sign: char| !sign.is_ascii(), "?");
    for (title, latex) in equations {
        document.push_str(&format!("\\section*{{\\detokenize{{{}}}}}\n{latex}", ascii(title)));
    }
    document.push_str("\\end{document}\n");
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    fs::write(folder.join(format!("{name}.tex")), document).expect("a folder that can be written");
    let arguments = ["-halt-on-error", "-file-line-error", "-interaction=batchmode", &format!("{name}.tex")];
    let status = Command::new("pdflatex").args(arguments).current_dir(&folder).output().expect("TeX runs").status;
    let log = String::from_utf8_lossy(&fs::read(folder.join(format!("{name}.log"))).unwrap_or_default()).into_owned();
    let wrong: Vec<&str> = log.lines().filter(|line| line.contains(".tex:") || line.starts_with('!')).collect();
    // A line that is too wide leaves the page.
    let lost = log.lines().filter(|line| line.starts_with("Missing character") || line.starts_with("Overfull"));
    let wrong: Vec<&str> = wrong.into_iter().chain(lost).take(20).collect();
    Some(if status.success() { wrong.join("\n") } else { format!("TeX stopped: {}", wrong.join("\n")) })
}
