//! `.vtu`: the VTK XML format for unstructured grids, ASCII. Reference: VTK User's Guide, "XML file formats".

use super::scan::{Complaint, Words};
use crate::geometry::DVec2;
use crate::mesh::Mesh;
use std::fmt::Write;

/// VTK's number for a triangle.
const TRIANGLE: u8 = 5;
/// Cells of dimension 0 and 1, which are skipped: vertex, poly-vertex, line, poly-line.
const LOWER: [u8; 4] = [1, 2, 3, 4];

/// The name of the array that carries a value for each point.
const VALUES: &str = "u";

/// Points with `marker`, and [`VALUES`] where there are some, triangles with `region`.
pub fn text(mesh: &Mesh, values: Option<&[f64]>) -> String {
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n\
         <UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
        mesh.points.len(),
        mesh.triangles.len()
    );
    let triangles = mesh.triangles.len();
    text.push_str("<Points>\n");
    array(
        &mut text,
        "Points",
        "Float64\" NumberOfComponents=\"3",
        mesh.points.iter(),
        |text, p| write!(text, "{:?} {:?} 0.0", p.x, p.y),
    );
    text.push_str("</Points>\n<Cells>\n");
    array(
        &mut text,
        "connectivity",
        "Int64",
        mesh.triangles.iter(),
        |text, [a, b, c]| write!(text, "{a} {b} {c}"),
    );
    array(&mut text, "offsets", "Int64", 1..=triangles, |text, k| {
        write!(text, "{}", 3 * k)
    });
    array(&mut text, "types", "UInt8", 0..triangles, |text, _| {
        write!(text, "{TRIANGLE}")
    });
    text.push_str("</Cells>\n<PointData Scalars=\"marker\">\n");
    array(
        &mut text,
        "marker",
        "Int32",
        mesh.point_markers.iter(),
        |text, marker| write!(text, "{marker}"),
    );
    if let Some(values) = values {
        array(&mut text, VALUES, "Float64", values.iter(), |text, value| {
            write!(text, "{value:?}")
        });
    }
    text.push_str("</PointData>\n<CellData Scalars=\"region\">\n");
    array(&mut text, "region", "Float64", mesh.regions.iter(), |text, region| {
        write!(text, "{region:?}")
    });
    text.push_str("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    text
}

/// One data array, one item per line.
fn array<T>(
    text: &mut String,
    name: &str,
    kind: &str,
    items: impl Iterator<Item = T>,
    one: impl Fn(&mut String, T) -> std::fmt::Result,
) {
    let _ = writeln!(text, "<DataArray Name=\"{name}\" type=\"{kind}\" format=\"ascii\">");
    for item in items {
        let _ = one(text, item); // writing to a string cannot fail
        text.push('\n');
    }
    text.push_str("</DataArray>\n");
}

/// A data array found in a file.
struct Array<'a> {
    /// The element around it: `Points`, `Cells`, `PointData`, `CellData`.
    section: &'a str,
    name: &'a str,
    format: &'a str,
    components: usize,
    text: &'a str,
    line: usize,
}

impl<'a> Array<'a> {
    fn words(&self) -> Result<Words<'a>, Complaint> {
        if self.format == "ascii" {
            return Ok(Words::new(self.text, self.line, false));
        }
        let message = format!("{} is stored as `{}`: save the file as ASCII", self.name, self.format);
        Err(Complaint {
            line: self.line,
            message,
        })
    }
}

/// Points without their z, and triangles; vertices and lines are skipped, other cells refused.
pub fn parse(text: &str) -> Result<Mesh, Complaint> {
    let arrays = arrays(text);
    let find = |section: &str, name: &str| {
        arrays
            .iter()
            .find(|array| array.section == section && (name.is_empty() || array.name == name))
    };
    let need = |section: &str, name: &str| {
        let message = || format!("no data array {name} in an element {section}: not a .vtu file").replace("  ", " ");
        find(section, name).ok_or_else(|| Complaint {
            line: 1,
            message: message(),
        })
    };
    let mut mesh = Mesh {
        points: points(need("Points", "")?)?,
        ..Mesh::default()
    };
    let mut kept = Vec::new();
    triangles(
        &mut mesh,
        &mut kept,
        need("Cells", "connectivity")?.words()?,
        need("Cells", "offsets")?.words()?,
        need("Cells", "types")?.words()?,
    )?;
    mesh.point_markers = match find("PointData", "marker") {
        Some(array) => numbers(array, mesh.points.len())?
            .into_iter()
            .map(|x| x as i32)
            .collect(),
        None => vec![0; mesh.points.len()],
    };
    mesh.regions = match find("CellData", "region") {
        Some(array) => {
            let all = numbers(array, kept.len())?;
            all.into_iter()
                .zip(&kept)
                .filter(|(_, kept)| **kept)
                .map(|(region, _)| region)
                .collect()
        }
        None => vec![0.0; mesh.triangles.len()],
    };
    Ok(mesh)
}

/// A value for each of `count` points, from the array [`VALUES`] or else from the first one besides the markers.
pub fn values(text: &str, count: usize) -> Result<Vec<f64>, Complaint> {
    let arrays = arrays(text);
    let mut of_points = arrays.iter().filter(|array| array.section == "PointData");
    let named = of_points.clone().find(|array| array.name == VALUES);
    match named.or_else(|| of_points.find(|array| array.name != "marker")) {
        Some(array) => numbers(array, count),
        None => Ok(Vec::new()),
    }
}

fn numbers(array: &Array, count: usize) -> Result<Vec<f64>, Complaint> {
    let mut words = array.words()?;
    (0..count).map(|_| words.number(array.name)).collect()
}

fn points(array: &Array) -> Result<Vec<DVec2>, Complaint> {
    let mut words = array.words()?;
    let mut points = Vec::new();
    let mut peek = words.clone();
    while peek.next().is_some() {
        points.push(DVec2::new(words.coordinate()?, words.coordinate()?));
        for _ in 2..array.components {
            words.coordinate()?;
        }
        peek = words.clone();
    }
    Ok(points)
}

/// Reads all cells; for each, `kept` gets whether it is a triangle.
fn triangles(
    mesh: &mut Mesh,
    kept: &mut Vec<bool>,
    mut connectivity: Words,
    mut offsets: Words,
    mut types: Words,
) -> Result<(), Complaint> {
    let mut start = 0usize;
    let mut peek = types.clone();
    while peek.next().is_some() {
        let kind: u8 = types.number("cell type")?;
        let end: usize = offsets.number("offset")?;
        let count = end
            .checked_sub(start)
            .ok_or_else(|| offsets.complain("offsets do not grow"))?;
        start = end;
        if kind == TRIANGLE && count == 3 {
            let mut corners = [0; 3];
            for corner in &mut corners {
                *corner = connectivity.index("point", 0, mesh.points.len())?;
            }
            mesh.triangles.push(corners);
        } else if LOWER.contains(&kind) {
            for _ in 0..count {
                connectivity.number::<u64>("point")?;
            }
        } else {
            return Err(types.complain(format!(
                "a cell of VTK type {kind} with {count} points is not a triangle"
            )));
        }
        kept.push(kind == TRIANGLE);
        peek = types.clone();
    }
    Ok(())
}

/// All data arrays of the file, in order.
fn arrays(text: &str) -> Vec<Array<'_>> {
    let mut found = Vec::new();
    let mut section = "";
    let (mut at, mut line) = (0, 1);
    while let Some(open) = text[at..].find('<').map(|k| at + k) {
        line += lines(&text[at..open]);
        let Some(close) = text[open..].find('>').map(|k| open + k) else {
            break;
        };
        let tag = &text[open + 1..close];
        line += lines(tag);
        at = close + 1;
        let name = tag.split_ascii_whitespace().next().unwrap_or("").trim_end_matches('/');
        match name {
            "Points" | "Cells" | "PointData" | "CellData" => section = name,
            "DataArray" if !tag.ends_with('/') => {
                let end = text[at..].find('<').map_or(text.len(), |k| at + k);
                found.push(Array {
                    section,
                    name: attribute(tag, "Name").unwrap_or(""),
                    format: attribute(tag, "format").unwrap_or("ascii"),
                    components: attribute(tag, "NumberOfComponents")
                        .and_then(|n| n.parse().ok())
                        .unwrap_or(3),
                    text: &text[at..end],
                    line,
                });
            }
            _ => {}
        }
    }
    found
}

fn lines(text: &str) -> usize {
    text.bytes().filter(|byte| *byte == b'\n').count()
}

/// The value of `name="…"` in a tag.
fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    tag.match_indices(name).find_map(|(at, _)| {
        let before = tag[..at].chars().next_back();
        let rest = tag[at + name.len()..].trim_start().strip_prefix('=')?.trim_start();
        let quote = rest.chars().next().filter(|c| *c == '"' || *c == '\'')?;
        let value = rest[1..].split(quote).next()?;
        before.is_some_and(|c| c.is_ascii_whitespace()).then_some(value)
    })
}
