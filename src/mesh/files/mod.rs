//! Mesh files: the formats, and the functions that write and read them.
//!
//! | ending | writes | reads | keeps |
//! |---|---|---|---|
//! | `.node` | `.node` and `.ele` as Triangle defines them, counted from 0 | both; counted from 0 or 1 | markers, regions, a value for each point |
//! | `.vtu` | VTK unstructured grid, ASCII | ASCII; binary is refused, saying so | markers, regions, a value for each point |
//! | `.msh` | Gmsh 4.1, ASCII | 4.1 and 2.2, ASCII | segment markers as curves, regions as surfaces |
//! | `.obj` | Wavefront, z = 0 | triangles and polygons as fans | geometry |
//! | `.svg` | a drawing | – | – |
//! | `.json` | every field of [`Mesh`] | the same | everything |
//!
//! Numbers are the shortest text that reads back to the same double.

mod gmsh;
mod json;
mod obj;
mod scan;
mod svg;
mod triangle;
mod vtu;

use crate::geometry::DVec2;
use crate::mesh::Mesh;
use std::path::{Path, PathBuf};

pub use json::text as json_text;

/// Why a mesh file could not be written or read.
#[derive(Debug, thiserror::Error)]
pub enum MeshFileError {
    /// The file system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The ending names no format.
    #[error("{}: no mesh format has this ending; known are {known}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// Endings that would do.
        known: String,
    },
    /// The text is not what the format says.
    #[error("{}:{line}: {message}", path.display())]
    Syntax {
        /// The file.
        path: PathBuf,
        /// Line, counted from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
}

/// A file format of meshes, chosen by a file's ending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// `.node` with its `.ele` (either name stands for both).
    Triangle,
    /// `.vtu`.
    Vtu,
    /// `.msh`.
    Gmsh,
    /// `.obj`.
    Obj,
    /// `.svg`, written only.
    Svg,
    /// `.json`.
    Json,
}

/// Endings and formats, in the order in which messages list them.
const ENDINGS: [(&str, Format); 7] = [
    ("node", Format::Triangle),
    ("ele", Format::Triangle),
    ("vtu", Format::Vtu),
    ("msh", Format::Gmsh),
    ("obj", Format::Obj),
    ("svg", Format::Svg),
    ("json", Format::Json),
];

impl Format {
    /// The format that the ending of `path` names, in any case.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?;
        ENDINGS
            .iter()
            .find(|(name, _)| name.eq_ignore_ascii_case(ending))
            .map(|(_, format)| *format)
    }

    /// Whether [`read`] knows the format.
    pub fn is_readable(self) -> bool {
        self != Self::Svg
    }
}

/// The format of `path`, if `allowed` accepts it.
fn format_of(path: &Path, allowed: impl Fn(Format) -> bool) -> Result<Format, MeshFileError> {
    Format::of(path).filter(|format| allowed(*format)).ok_or_else(|| {
        let known = ENDINGS
            .iter()
            .filter(|(_, format)| allowed(*format))
            .map(|(name, _)| format!(".{name}"));
        MeshFileError::Format {
            path: path.to_path_buf(),
            known: known.collect::<Vec<_>>().join(", "),
        }
    })
}

/// Writes `mesh` in the format that the ending of `path` names.
///
/// # Errors
/// An unknown ending, or what the file system says.
pub fn write(mesh: &Mesh, path: &Path) -> Result<(), MeshFileError> {
    put(&encode(mesh, path)?)
}

/// What [`write()`] writes: the files with their bytes, of which a `.node` has two.
///
/// # Errors
/// An unknown ending.
pub fn encode(mesh: &Mesh, path: &Path) -> Result<Vec<(PathBuf, Vec<u8>)>, MeshFileError> {
    let text = match format_of(path, |_| true)? {
        Format::Triangle => return Ok(encode_triangle(mesh, None, path)),
        Format::Vtu => vtu::text(mesh, None),
        Format::Gmsh => gmsh::text(mesh),
        Format::Obj => obj::text(mesh),
        Format::Svg => svg::text(mesh),
        Format::Json => json::text(mesh),
    };
    Ok(vec![(path.to_owned(), text.into_bytes())])
}

/// Whether a format can carry a value for each point.
fn has_values(format: Format) -> bool {
    matches!(format, Format::Triangle | Format::Vtu)
}

/// Whether the ending of `path` names a format that can carry a value for each point.
pub fn carries_values(path: &Path) -> bool {
    Format::of(path).is_some_and(has_values)
}

/// Writes `mesh` with a value for each of its points: as attribute of a `.node`, as array `u` of a `.vtu`.
///
/// # Errors
/// An ending that can carry no values, or what the file system says.
pub fn write_with_values(mesh: &Mesh, values: &[f64], path: &Path) -> Result<(), MeshFileError> {
    put(&encode_with_values(mesh, values, path)?)
}

/// What [`write_with_values`] writes.
///
/// # Errors
/// An ending that can carry no values.
pub fn encode_with_values(mesh: &Mesh, values: &[f64], path: &Path) -> Result<Vec<(PathBuf, Vec<u8>)>, MeshFileError> {
    Ok(match format_of(path, has_values)? {
        Format::Triangle => encode_triangle(mesh, Some(values), path),
        _ => vec![(path.to_owned(), vtu::text(mesh, Some(values)).into_bytes())],
    })
}

fn encode_triangle(mesh: &Mesh, values: Option<&[f64]>, path: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let (node, ele) = (triangle::node_text(mesh, values), triangle::ele_text(mesh));
    vec![
        (path.with_extension("node"), node.into_bytes()),
        (path.with_extension("ele"), ele.into_bytes()),
    ]
}

/// Reads a mesh with a value for each of its points: the first attribute of a `.node`, the array `u` of a `.vtu`, or else its
/// first one besides the markers.
///
/// # Errors
/// Those of [`read`]; a format that carries no values; a file without such values, or with some that are not finite.
pub fn read_with_values(path: &Path) -> Result<(Mesh, Vec<f64>), MeshFileError> {
    match format_of(path, has_values)? {
        Format::Triangle => {
            let (node, ele) = (path.with_extension("node"), path.with_extension("ele"));
            let (mut mesh, base, values) = parse(&node, triangle::parse_node_with_values)?;
            parse(&ele, |text| triangle::parse_ele(text, &mut mesh, base))?;
            with_values(mesh, values, &node)
        }
        _ => read_vtu_with_values(path),
    }
}

/// The same without triangles: the `.ele` beside a `.node` need not be there.
///
/// # Errors
/// As [`read_with_values`].
pub fn read_points_with_values(path: &Path) -> Result<(Vec<DVec2>, Vec<f64>), MeshFileError> {
    let (mesh, values) = match format_of(path, has_values)? {
        Format::Triangle => {
            let node = path.with_extension("node");
            let (mesh, _, values) = parse(&node, triangle::parse_node_with_values)?;
            with_values(mesh, values, &node)
        }
        _ => read_vtu_with_values(path),
    }?;
    Ok((mesh.points, values))
}

fn read_vtu_with_values(path: &Path) -> Result<(Mesh, Vec<f64>), MeshFileError> {
    let (mesh, values) = parse(path, |text| {
        let mesh = vtu::parse(text)?;
        let values = vtu::values(text, mesh.points.len())?;
        Ok((mesh, values))
    })?;
    with_values(mesh, values, path)
}

/// Refuses values that are not one finite number for each point.
fn with_values(mesh: Mesh, values: Vec<f64>, path: &Path) -> Result<(Mesh, Vec<f64>), MeshFileError> {
    let fault = match values.iter().position(|value| !value.is_finite()) {
        Some(vertex) => format!("the value of vertex {vertex} is not finite"),
        None if values.len() == mesh.points.len() => return Ok((mesh, values)),
        None => "it has no values at its points: a .node needs an attribute, a .vtu an array in PointData".into(),
    };
    Err(MeshFileError::Syntax {
        path: path.to_path_buf(),
        line: 1,
        message: fault,
    })
}

/// Reads a mesh from a file of any origin. Triangles keep their orientation; vertices that no triangle uses are kept.
///
/// Formats other than `.json` do not say which edges lie on the input's segments: then `pieces` is empty, and the
/// certificate finds them by the coordinates.
///
/// # Errors
/// An unknown ending, what the file system says, or the first line that is not as the format defines it.
pub fn read(path: &Path) -> Result<Mesh, MeshFileError> {
    match format_of(path, Format::is_readable)? {
        Format::Triangle => {
            let (node, ele) = (path.with_extension("node"), path.with_extension("ele"));
            let (mut mesh, base) = parse(&node, triangle::parse_node)?;
            parse(&ele, |text| triangle::parse_ele(text, &mut mesh, base))?;
            Ok(mesh)
        }
        Format::Vtu => parse(path, vtu::parse),
        Format::Gmsh => parse(path, gmsh::parse),
        Format::Obj => parse(path, obj::parse),
        Format::Json | Format::Svg => parse(path, json::parse),
    }
}

fn put(files: &[(PathBuf, Vec<u8>)]) -> Result<(), MeshFileError> {
    files.iter().try_for_each(|(path, bytes)| {
        std::fs::write(path, bytes).map_err(|source| MeshFileError::Io {
            path: path.clone(),
            source,
        })
    })
}

/// Reads a file and passes its text to a parser, whose complaints get the file's name.
fn parse<T>(path: &Path, parser: impl FnOnce(&str) -> Result<T, scan::Complaint>) -> Result<T, MeshFileError> {
    let text = std::fs::read_to_string(path).map_err(|source| MeshFileError::Io {
        path: path.to_path_buf(),
        source,
    })?;
    parser(&text).map_err(|scan::Complaint { line, message }| MeshFileError::Syntax {
        path: path.to_path_buf(),
        line,
        message,
    })
}

#[cfg(test)]
mod tests;
