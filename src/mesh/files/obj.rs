//! Wavefront `.obj`: `v x y z` and `f a b c`, counted from 1.

use super::scan::{Complaint, Words};
use crate::geometry::DVec2;
use crate::mesh::Mesh;
use std::fmt::Write;

/// All points at z = 0, all triangles.
pub fn text(mesh: &Mesh) -> String {
    let mut text = String::new();
    for p in &mesh.points {
        let _ = writeln!(text, "v {:?} {:?} 0.0", p.x, p.y); // writing to a string cannot fail
    }
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text
}

/// Points without their z and faces, which must be triangles; everything else is skipped.
pub fn parse(text: &str) -> Result<Mesh, Complaint> {
    let mut mesh = Mesh::default();
    let mut words = Words::new(text, 1, true);
    while let Some(word) = words.next() {
        match word {
            "v" => mesh.points.push(DVec2::new(words.coordinate()?, words.coordinate()?)),
            "f" => {
                let corners: Vec<&str> = words.finish_line().collect();
                let &[a, b, c] = corners.as_slice() else {
                    return Err(words.complain(format!("a face of {} corners is not a triangle", corners.len())));
                };
                let mut triangle = [0; 3];
                for (slot, word) in triangle.iter_mut().zip([a, b, c]) {
                    *slot = corner(word, mesh.points.len())
                        .ok_or_else(|| words.complain(format!("`{word}` names no vertex above this line")))?;
                }
                mesh.triangles.push(triangle);
                continue;
            }
            _ => {}
        }
        words.skip_line();
    }
    mesh.point_markers = vec![0; mesh.points.len()];
    mesh.regions = vec![0.0; mesh.triangles.len()];
    Ok(mesh)
}

/// `7`, `7/1`, `7//3` or, counted back from the last, `-1`.
fn corner(word: &str, points: usize) -> Option<u32> {
    let index: i64 = word.split('/').next()?.parse().ok()?;
    let index = if index < 0 { points as i64 + index } else { index - 1 };
    u32::try_from(index).ok().filter(|k| (*k as usize) < points)
}
