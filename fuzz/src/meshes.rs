//! Readers of meshes: what they read can be judged against a domain it has nothing to do with, and written and read
//! back.

use crate::scratch;
use biting::domain::{Domain, load};
use biting::mesh::Mesh;
use biting::mesh::files::{read, read_points_with_values, read_with_values, write};
use biting::quality::judge;
use biting::spacing::{Spacing, of_samples};
use std::sync::OnceLock;

/// `.node`, after a zero byte `.ele`.
pub fn triangle(data: &[u8]) {
    let cut = data.iter().position(|byte| *byte == 0).unwrap_or(data.len());
    let (node, ele) = data.split_at(cut);
    scratch::put("m.ele", ele.get(1..).unwrap_or(&[]));
    check("node", node);
    check_values("m.node");
}

/// `.vtu`.
pub fn vtu(data: &[u8]) {
    check("vtu", data);
    check_values("m.vtu");
}

/// `.msh`.
pub fn msh(data: &[u8]) {
    check("msh", data);
}

/// `.obj`.
pub fn obj(data: &[u8]) {
    check("obj", data);
}

/// `.json`.
pub fn json(data: &[u8]) {
    if let Some((mesh, back)) = check("json", data) {
        assert_eq!(mesh, back, "json keeps everything");
    }
}

/// Reads, judges, writes and reads again.
fn check(ending: &str, data: &[u8]) -> Option<(Mesh, Mesh)> {
    static SQUARE: OnceLock<Domain> = OnceLock::new();
    let square = SQUARE.get_or_init(|| load("unit-square").expect("a gallery domain"));
    let mesh = match read(&scratch::put(&format!("m.{ending}"), data)) {
        Ok(mesh) => mesh,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return None;
        }
    };
    let corners = mesh.triangles.as_flattened();
    assert!(corners.iter().all(|k| (*k as usize) < mesh.points.len()));
    judge(square, &mesh, None);
    let path = scratch::path(&format!("back.{ending}"));
    write(&mesh, &path).expect("a mesh can be written");
    let back = read(&path).expect("what was written can be read");
    assert_eq!(mesh.points, back.points);
    assert_eq!(mesh.triangles.len(), back.triangles.len());
    Some((mesh, back))
}

/// Reads values at points, with triangles and without: as many as points and finite, and as sizes they have an envelope.
fn check_values(name: &str) {
    let path = scratch::path(name);
    if let Ok((mesh, values)) = read_with_values(&path) {
        let (points, same) =
            read_points_with_values(&path).expect("values that are read with triangles are read without");
        assert_eq!((points, same), (mesh.points, values));
    }
    let Ok((points, values)) = read_points_with_values(&path) else {
        return;
    };
    assert_eq!(points.len(), values.len());
    assert!(values.iter().all(|value| value.is_finite()));
    if let Ok(envelope) = of_samples(0.5, &points, &values) {
        for (point, value) in points.iter().zip(&values) {
            assert!(envelope.at(*point) <= *value, "above the sample at {point}");
        }
    }
}
