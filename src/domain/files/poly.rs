//! Reads Triangle's `.poly` files, and the `.node` file beside one that holds no vertices itself.
//!
//! Four sections, each opened by a line with its count: vertices (`number x y attributes… marker`), segments (`number end
//! end marker`), hole points (`number x y`), and, if present, regions (`number x y attribute area`; with one value only
//! it is both, as in Triangle). Everything after `#` is a comment, empty lines are skipped, commas count as blanks. Vertices
//! are numbered in sequence from 0 or 1, and segments name them by these numbers.
//!
//! Reference: J. R. Shewchuk, "Triangle: Engineering a 2D Quality Mesh Generator and Delaunay Triangulator", and the
//! format's description that comes with it.

use crate::domain::{DomainError, Fill, InputSegment, Pslg, Region};
use crate::geometry::DVec2;
use std::str::FromStr;

/// Parses the text of a `.poly` file; `node` returns text and name of the `.node` file, and is called only if needed.
///
/// # Errors
/// [`DomainError::Syntax`] with the line, or the error of `node`.
pub fn parse(
    text: &str,
    file: &str,
    node: impl FnOnce() -> Result<(String, String), DomainError>,
) -> Result<Pslg, DomainError> {
    let mut lines = Lines::new(text, file);
    let mut pslg = Pslg::new(file);
    let header = lines.header("the number of vertices")?;
    if header.count == 0 {
        let (text, node_file) = node()?;
        let mut node_lines = Lines::new(&text, &node_file);
        let node_header = node_lines.header("the number of vertices")?;
        read_vertices(&mut node_lines, &node_header, &mut pslg)?;
        pslg.source.vertex_file = Some(node_file);
    } else {
        read_vertices(&mut lines, &header, &mut pslg)?;
    }
    read_segments(&mut lines, &mut pslg)?;
    read_holes(&mut lines, &mut pslg)?;
    read_regions(&mut lines, &mut pslg)?;
    if let Some(line) = lines.next() {
        return Err(lines.error(line.number, format!("\"{}\" where the file should end", line.fields[0])));
    }
    Ok(pslg)
}

fn read_vertices(lines: &mut Lines, header: &Header, pslg: &mut Pslg) -> Result<(), DomainError> {
    if header.extra.first().is_some_and(|&dimension| dimension != 2) {
        let found = header.extra[0];
        return Err(lines.error(header.line, format!("vertices of dimension {found}; only 2 is read")));
    }
    let attributes = header.extra.get(1).copied().unwrap_or(0);
    let has_marker = header.extra.get(2).is_some_and(|&flag| flag > 0);
    for v in 0..header.count {
        let line = lines.entry("vertex", v, header)?;
        let number: usize = lines.field(&line, 0, "the vertex' number")?;
        if v == 0 && number <= 1 {
            pslg.source.first_number = number;
        }
        let expected = v + pslg.source.first_number;
        if number != expected {
            let message =
                format!("vertex number {number} where {expected} was expected; number from 0 or 1 in sequence");
            return Err(lines.error(line.number, message));
        }
        pslg.vertices.push(lines.point(&line)?);
        let column = attributes.saturating_add(3);
        let marker = if has_marker && line.fields.len() > column {
            lines.field(&line, column, "the marker")?
        } else {
            0
        };
        pslg.vertex_markers.push(marker);
        pslg.source.vertex_lines.push(line.number);
    }
    Ok(())
}

fn read_segments(lines: &mut Lines, pslg: &mut Pslg) -> Result<(), DomainError> {
    let header = lines.header("the number of segments")?;
    let has_marker = header.extra.first().is_some_and(|&flag| flag > 0);
    for s in 0..header.count {
        let line = lines.entry("segment", s, &header)?;
        let end = |column: usize| {
            let number: usize = lines.field(&line, column, "the number of a vertex")?;
            number.checked_sub(pslg.source.first_number).ok_or_else(|| {
                lines.error(
                    line.number,
                    "vertex 0 in a file that numbers vertices from 1".to_owned(),
                )
            })
        };
        let (a, b) = (end(1)?, end(2)?);
        let marker = if has_marker && line.fields.len() > 3 {
            lines.field(&line, 3, "the marker")?
        } else {
            0
        };
        pslg.segments.push(InputSegment { a, b, marker });
        pslg.source.segment_lines.push(line.number);
    }
    Ok(())
}

fn read_holes(lines: &mut Lines, pslg: &mut Pslg) -> Result<(), DomainError> {
    let Some(header) = lines.optional_header("the number of holes")? else {
        return Ok(());
    };
    let mut points = Vec::new();
    for h in 0..header.count {
        let line = lines.entry("hole", h, &header)?;
        points.push(lines.point(&line)?);
        pslg.source.hole_lines.push(line.number);
    }
    pslg.fill = Fill::HolePoints(points);
    Ok(())
}

fn read_regions(lines: &mut Lines, pslg: &mut Pslg) -> Result<(), DomainError> {
    let Some(header) = lines.optional_header("the number of regions")? else {
        return Ok(());
    };
    for r in 0..header.count {
        let line = lines.entry("region", r, &header)?;
        let point = lines.point(&line)?;
        let attribute: f64 = lines.field(&line, 3, "the region's attribute")?;
        let area = if line.fields.len() > 4 {
            lines.field(&line, 4, "the region's largest area")?
        } else {
            attribute
        };
        pslg.regions.push(Region {
            point,
            attribute,
            max_area: Some(area).filter(|&area: &f64| area > 0.0),
        });
        pslg.source.region_lines.push(line.number);
    }
    Ok(())
}

/// The first line of a section.
struct Header {
    line: usize,
    count: usize,
    extra: Vec<usize>,
}

/// A line that is not empty, cut into fields.
struct Line<'a> {
    number: usize,
    fields: Vec<&'a str>,
}

/// The lines of a file that contain more than a comment.
struct Lines<'a> {
    file: &'a str,
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    last: usize,
}

impl<'a> Lines<'a> {
    fn new(text: &'a str, file: &'a str) -> Self {
        Self {
            file,
            lines: text.lines().enumerate(),
            last: 0,
        }
    }

    fn next(&mut self) -> Option<Line<'a>> {
        for (index, text) in self.lines.by_ref() {
            let content = text.split('#').next().unwrap_or("");
            let fields: Vec<&str> = content
                .split(|c: char| c.is_whitespace() || c == ',')
                .filter(|field| !field.is_empty())
                .collect();
            if !fields.is_empty() {
                self.last = index + 1;
                return Some(Line {
                    number: index + 1,
                    fields,
                });
            }
        }
        None
    }

    fn error(&self, line: usize, message: String) -> DomainError {
        DomainError::Syntax {
            file: self.file.to_owned(),
            line: Some(line),
            message,
        }
    }

    fn optional_header(&mut self, what: &str) -> Result<Option<Header>, DomainError> {
        let Some(line) = self.next() else {
            return Ok(None);
        };
        let count = self.field(&line, 0, what)?;
        let extra = (1..line.fields.len())
            .map(|column| self.field(&line, column, "a whole number"))
            .collect::<Result<_, _>>()?;
        Ok(Some(Header {
            line: line.number,
            count,
            extra,
        }))
    }

    fn header(&mut self, what: &str) -> Result<Header, DomainError> {
        self.optional_header(what)?
            .ok_or_else(|| self.error(self.last + 1, format!("the file ends where {what} should stand")))
    }

    /// The line of entry `i` of the section that `header` opened.
    fn entry(&mut self, what: &str, i: usize, header: &Header) -> Result<Line<'a>, DomainError> {
        self.next().ok_or_else(|| {
            let message = format!(
                "the file ends after {i} of {} {what} lines promised in line {}",
                header.count, header.line
            );
            self.error(self.last + 1, message)
        })
    }

    fn point(&self, line: &Line) -> Result<DVec2, DomainError> {
        Ok(DVec2::new(self.field(line, 1, "x")?, self.field(line, 2, "y")?))
    }

    fn field<T: FromStr>(&self, line: &Line, column: usize, what: &str) -> Result<T, DomainError> {
        let Some(field) = line.fields.get(column) else {
            return Err(self.error(line.number, format!("the line ends where {what} should stand")));
        };
        field
            .parse()
            .map_err(|_| self.error(line.number, format!("\"{field}\" where {what} should stand")))
    }
}
