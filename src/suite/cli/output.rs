//! Writing meshes by the ending of a file's name, and telling a certificate.

use super::exit::{Failure, Outcome};
use crate::domain::Domain;
use crate::mesh::{Mesh, files};
use crate::quality::{Certificate, Check};
use crate::suite::charts;
use crate::suite::files::{write_together, write_whole};
use crate::suite::run::prepare::Store;
use std::fmt::Display;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Prints a line to standard output. Whoever reads may have stopped, as `head` does: no reason to stop working.
pub fn say(text: impl Display) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// Prints a line to standard error, on the same terms.
pub fn say_aside(text: impl Display) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// Tells what was mended in a domain, and what reading it brought to light.
pub fn say_notes(store: &Store, domain: &Domain) {
    for changes in store.repairs() {
        say_aside(format_args!("repair of {}: {changes}", domain.name()));
    }
    for note in domain.notes() {
        say_aside(format_args!("note: {note}"));
    }
}

/// Where a mesh goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// JSON on standard output.
    Stdout,
    /// The domain itself, as Triangle reads it.
    Poly(PathBuf),
    /// A picture of dots.
    Png(PathBuf),
    /// A mesh file.
    Mesh(PathBuf),
}

impl Target {
    /// Reads `--out`; an ending no format has is told before any work is done.
    pub fn parse(text: &str) -> Result<Self, Failure> {
        let path = PathBuf::from(text);
        let ending = path
            .extension()
            .map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        match ending.as_deref() {
            _ if text == STDOUT => Ok(Self::Stdout),
            Some("poly") => Ok(Self::Poly(path)),
            Some("png") => Ok(Self::Png(path)),
            _ if files::Format::of(&path).is_some() => Ok(Self::Mesh(path)),
            _ => Err(Failure::Input(format!(
                "--out {text}: no format has this ending; use .node, .vtu, .msh, .obj, .svg, .png, .json, .poly or -"
            ))),
        }
    }

    /// All of them.
    pub fn parse_all(texts: &[String]) -> Result<Vec<Self>, Failure> {
        texts.iter().map(|text| Self::parse(text)).collect()
    }
}

/// The name that stands for standard output.
pub const STDOUT: &str = "-";

/// Writes what was asked for on standard output: unlike what is only said, it must get there.
pub fn write_out(text: &str) -> Outcome {
    let mut out = std::io::stdout().lock();
    let written = writeln!(out, "{text}").and_then(|()| out.flush());
    written.map_err(|cause| refused(Path::new("standard output"), cause))
}

/// Writes a file, complete or not at all.
pub fn write_file(path: &Path, text: &str) -> Outcome {
    write_whole(path, text.as_bytes()).map_err(|cause| refused(path, cause))
}

/// Writes files that belong together, and returns their names.
pub fn write_all(files: Vec<(PathBuf, Vec<u8>)>) -> Result<Vec<PathBuf>, Failure> {
    write_together(&files).map_err(|(path, cause)| refused(path, cause))?;
    Ok(files.into_iter().map(|(path, _)| path).collect())
}

fn refused(path: &Path, cause: std::io::Error) -> Failure {
    Failure::Input(format!("{}: {cause}", path.display()))
}

/// Writes the mesh and gives the files that are now there.
pub fn write(target: &Target, domain: &Domain, mesh: &Mesh) -> Result<Vec<PathBuf>, Failure> {
    match target {
        Target::Stdout => {
            write_out(&files::json_text(mesh))?;
            Ok(Vec::new())
        }
        Target::Poly(path) => {
            write_file(path, &domain.to_poly())?;
            Ok(vec![path.clone()])
        }
        Target::Png(path) => {
            charts::draw_mesh(mesh, path).map_err(Failure::input)?;
            Ok(vec![path.clone()])
        }
        Target::Mesh(path) => write_all(files::encode(mesh, path).map_err(Failure::input)?),
    }
}

/// Ends the verb by what the certificate says.
pub fn verdict(certificate: &Certificate) -> Outcome {
    let broken: Vec<String> = certificate.broken().map(told).collect();
    if certificate.holds {
        let applying = certificate.checks.iter().filter(|check| check.applies).count();
        say_aside(format_args!("certificate: {applying} checks apply and hold"));
        Ok(())
    } else {
        Err(Failure::Broken(format!(
            "a guaranteed check failed: {}",
            broken.join("; ")
        )))
    }
}

/// A check in words.
pub fn told(check: &Check) -> String {
    let number = |value: Option<f64>| match value {
        None => "–".into(),
        Some(value) if value != 0.0 && !(1e-3..1e7).contains(&value.abs()) => format!("{value:.3e}"),
        Some(value) => format!("{value:.6}"),
    };
    let place = check.at.map_or_else(String::new, |[x, y]| format!(" at ({x}, {y})"));
    let lemma = if check.lemma.is_empty() {
        String::new()
    } else {
        format!(" ({})", check.lemma)
    };
    let broken = if check.broken > 0 {
        format!(", {} broken", check.broken)
    } else {
        String::new()
    };
    format!(
        "{}{lemma}: worst {} against {}{place}{broken}",
        check.claim,
        number(check.worst),
        number(check.bound)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_values_are_told_with_their_digits() {
        let check = |worst, bound| Check {
            claim: crate::theory::Claim::Area,
            lemma: String::new(),
            applies: true,
            worst: Some(worst),
            bound: Some(bound),
            holds: false,
            broken: 1,
            at: None,
            witnesses: Vec::new(),
        };
        assert_eq!(
            told(&check(2.5e-8, 1e-9)),
            "area: worst 2.500e-8 against 1.000e-9, 1 broken"
        );
        assert_eq!(
            told(&check(0.0, 0.5)),
            "area: worst 0.000000 against 0.500000, 1 broken"
        );
    }
}
