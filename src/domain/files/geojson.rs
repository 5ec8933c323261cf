//! Reads GeoJSON polygons and multipolygons, alone, in features, or in collections of either.
//!
//! A face is inside if an odd number of rings separates it from far away, so holes and islands need no points. Equal
//! positions are one vertex, and where an even number of rings runs along a segment (two countries' common border) it
//! becomes an inner segment. Other geometries are left out with a note.
//!
//! Reference: RFC 7946.

use crate::domain::{DomainError, Fill, InputSegment, Pslg};
use crate::geometry::DVec2;
use geojson::{GeoJson, Geometry, GeometryValue, Position};
use std::collections::HashMap;

/// Parses the text of a GeoJSON file.
///
/// # Errors
/// [`DomainError::Syntax`] if the text is not GeoJSON or contains no polygon, or if a ring is not closed.
pub fn parse(text: &str, file: &str) -> Result<Pslg, DomainError> {
    let error = |line: Option<usize>, message: String| DomainError::Syntax {
        file: file.to_owned(),
        line,
        message,
    };
    let parsed: GeoJson = text
        .parse()
        .map_err(|fault: geojson::Error| error(json_line(text), fault.to_string()))?;
    let mut found = Found::default();
    match &parsed {
        GeoJson::Geometry(geometry) => found.geometry(geometry),
        GeoJson::Feature(feature) => feature.geometry.iter().for_each(|geometry| found.geometry(geometry)),
        GeoJson::FeatureCollection(collection) => {
            let geometries = collection
                .features
                .iter()
                .filter_map(|feature| feature.geometry.as_ref());
            geometries.for_each(|geometry| found.geometry(geometry));
        }
    }
    if found.rings.is_empty() {
        return Err(error(
            None,
            "holds no polygon; give a Polygon or MultiPolygon".to_owned(),
        ));
    }
    let mut build = Build {
        pslg: Pslg::new(file),
        flips: Vec::new(),
        vertex: HashMap::new(),
        segment: HashMap::new(),
    };
    let total: usize = found.rings.iter().map(|ring| ring.len()).sum();
    // If anything but polygons contains positions, the text alone does not show which line is whose.
    let lines = if found.skipped == 0 {
        position_lines(text)
    } else {
        Vec::new()
    };
    let lines = if lines.len() == total { lines } else { Vec::new() };
    let mut first = 0;
    for (r, ring) in found.rings.iter().enumerate() {
        let own_lines = lines.get(first..first + ring.len()).unwrap_or(&[]);
        build
            .ring(ring, own_lines)
            .map_err(|message| error(own_lines.last().copied(), format!("ring {}: {message}", r + 1)))?;
        first += ring.len();
    }
    let mut pslg = build.pslg;
    pslg.fill = Fill::EvenOdd { flips: build.flips };
    if found.skipped > 0 {
        pslg.notes
            .push(format!("left out {} geometries that are not polygons", found.skipped));
    }
    Ok(pslg)
}

/// The polygons' rings in the order of the file.
#[derive(Default)]
struct Found<'a> {
    rings: Vec<&'a [Position]>,
    skipped: usize,
}

impl<'a> Found<'a> {
    fn geometry(&mut self, geometry: &'a Geometry) {
        match &geometry.value {
            GeometryValue::Polygon { coordinates } => self.rings.extend(coordinates.iter().map(Vec::as_slice)),
            GeometryValue::MultiPolygon { coordinates } => {
                self.rings.extend(coordinates.iter().flatten().map(Vec::as_slice));
            }
            GeometryValue::GeometryCollection { geometries } => {
                geometries.iter().for_each(|geometry| self.geometry(geometry));
            }
            GeometryValue::Point { .. }
            | GeometryValue::MultiPoint { .. }
            | GeometryValue::LineString { .. }
            | GeometryValue::MultiLineString { .. } => self.skipped += 1,
        }
    }
}

/// The PSLG in the making. The maps are only looked up, never iterated.
struct Build {
    pslg: Pslg,
    flips: Vec<bool>,
    vertex: HashMap<[u64; 2], usize>,
    segment: HashMap<[usize; 2], usize>,
}

impl Build {
    fn ring(&mut self, ring: &[Position], lines: &[usize]) -> Result<(), String> {
        let points: Vec<DVec2> = ring
            .iter()
            .map(|position| match position.as_slice() {
                [x, y, ..] => Ok(DVec2::new(*x, *y)),
                _ => Err("a position needs two numbers".to_owned()),
            })
            .collect::<Result<_, _>>()?;
        match points.as_slice() {
            [first, _, _, .., last] if first == last => {}
            [first, _, .., last] if first == last => return Err("a ring needs at least four positions".to_owned()),
            _ => return Err("is not closed: repeat its first position at its end".to_owned()),
        }
        let line = |i: usize| lines.get(i).copied();
        let ids: Vec<usize> = points
            .iter()
            .enumerate()
            .map(|(i, &p)| self.vertex(p, line(i)))
            .collect();
        for (i, ends) in ids.windows(2).enumerate() {
            self.segment(ends[0], ends[1], line(i + 1));
        }
        Ok(())
    }

    fn vertex(&mut self, p: DVec2, line: Option<usize>) -> usize {
        // Adding 0 makes −0 and 0 the same position.
        let key = [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()];
        *self.vertex.entry(key).or_insert_with(|| {
            self.pslg.source.vertex_lines.extend(line);
            self.pslg.add_vertex(p)
        })
    }

    fn segment(&mut self, a: usize, b: usize, line: Option<usize>) {
        let key = [a.min(b), a.max(b)];
        // A repeated position is kept as a segment of length zero, for validation to report.
        if let Some(&known) = self.segment.get(&key).filter(|_| a != b) {
            self.flips[known] = !self.flips[known];
            return;
        }
        self.segment.insert(key, self.pslg.segments.len());
        self.pslg.segments.push(InputSegment { a, b, marker: 0 });
        self.pslg.source.segment_lines.extend(line);
        self.flips.push(a != b);
    }
}

/// The line where the text stops being JSON, if it stops.
fn json_line(text: &str) -> Option<usize> {
    serde_json::from_str::<serde::de::IgnoredAny>(text)
        .err()
        .map(|fault| fault.line())
}

/// The line of every innermost array of numbers in the text: its positions, if the GeoJSON has polygons and no boxes.
fn position_lines(text: &str) -> Vec<usize> {
    let mut lines = Vec::new();
    let (mut line, mut in_string, mut escaped) = (1, false, false);
    let mut opened: Option<usize> = None;
    for byte in text.bytes() {
        match byte {
            b'\n' => line += 1,
            _ if escaped => escaped = false,
            b'\\' if in_string => escaped = true,
            b'"' => {
                in_string = !in_string;
                opened = None;
            }
            _ if in_string => {}
            b'[' => opened = Some(line),
            b']' => lines.extend(opened.take()),
            b'{' | b'}' => opened = None,
            _ => {}
        }
    }
    lines
}
