//! `.node` and `.ele`, as Triangle defines them. Reference: <https://www.cs.cmu.edu/~quake/triangle.html>.

use super::scan::{Complaint, Words, parse};
use crate::geometry::DVec2;
use crate::mesh::Mesh;
use std::fmt::Write;

/// One line per point: index from 0, coordinates, its value where there are values, marker.
pub fn node_text(mesh: &Mesh, values: Option<&[f64]>) -> String {
    let mut text = format!("{} 2 {} 1\n", mesh.points.len(), u8::from(values.is_some()));
    for (k, (p, marker)) in mesh.points.iter().zip(&mesh.point_markers).enumerate() {
        let value = values.map_or_else(String::new, |values| format!("{:?} ", values[k]));
        let _ = writeln!(text, "{k} {:?} {:?} {value}{marker}", p.x, p.y); // writing to a string cannot fail
    }
    text
}

/// One line per triangle: index from 0, corners, region.
pub fn ele_text(mesh: &Mesh) -> String {
    let mut text = format!("{} 3 1\n", mesh.triangles.len());
    for (k, ([a, b, c], region)) in mesh.triangles.iter().zip(&mesh.regions).enumerate() {
        let _ = writeln!(text, "{k} {a} {b} {c} {region:?}");
    }
    text
}

/// Points and markers, and whether indices count from 0 or from 1.
pub fn parse_node(text: &str) -> Result<(Mesh, i64), Complaint> {
    let (mesh, base, _) = parse_node_with_values(text)?;
    Ok((mesh, base))
}

/// The same with the first attribute of each point, where there is one.
pub fn parse_node_with_values(text: &str) -> Result<(Mesh, i64, Vec<f64>), Complaint> {
    let mut words = Words::new(text, 1, true);
    let count: usize = words.number("number of vertices")?;
    let dimension: usize = words.number("dimension")?;
    if dimension != 2 {
        return Err(words.complain(format!("dimension {dimension} where 2 is needed")));
    }
    let mut head = words.finish_line();
    let attributes: usize = head.next().and_then(parse).unwrap_or(0);
    let marked = head.next().and_then(parse::<usize>).unwrap_or(0) > 0;
    let mut mesh = Mesh::default();
    let mut values = Vec::new();
    let mut base = 0;
    for k in 0..count {
        let index: i64 = words.number("vertex index")?;
        if k == 0 && index == 1 {
            base = 1;
        }
        if index != base + k as i64 {
            return Err(words.complain(format!("vertex {index} where {} should follow", base + k as i64)));
        }
        mesh.points.push(DVec2::new(words.coordinate()?, words.coordinate()?));
        for place in 0..attributes {
            let value = words.number::<f64>("attribute")?;
            values.extend((place == 0).then_some(value));
        }
        mesh.point_markers
            .push(if marked { words.number("marker")? } else { 0 });
    }
    Ok((mesh, base, values))
}

/// Adds the triangles and their first attribute as region; further nodes of a triangle are left out.
pub fn parse_ele(text: &str, mesh: &mut Mesh, base: i64) -> Result<(), Complaint> {
    let mut words = Words::new(text, 1, true);
    let count: usize = words.number("number of triangles")?;
    let nodes: usize = words.number("number of nodes per triangle")?;
    if nodes < 3 {
        return Err(words.complain(format!("{nodes} nodes per triangle")));
    }
    let attributes: usize = words.finish_line().next().and_then(parse).unwrap_or(0);
    for _ in 0..count {
        words.number::<i64>("triangle index")?;
        let mut corners = [0; 3];
        for corner in &mut corners {
            *corner = words.index("vertex", base, mesh.points.len())?;
        }
        for _ in 3..nodes {
            words.index("vertex", base, mesh.points.len())?;
        }
        let mut region = 0.0;
        for k in 0..attributes {
            let attribute = words.number("attribute")?;
            region = if k == 0 { attribute } else { region };
        }
        mesh.triangles.push(corners);
        mesh.regions.push(region);
    }
    Ok(())
}
