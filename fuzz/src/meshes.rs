//! Readers of meshes: what they read can be judged against a domain it has nothing to do with, and written and read
//! back.

use crate::scratch;
use biting::domain::{Domain, load};
use biting::mesh::Mesh;
use biting::mesh::files::{read, write};
use biting::quality::judge;
use std::sync::OnceLock;

/// `.node`, after a zero byte `.ele`.
pub fn triangle(data: &[u8]) {
    let cut = data.iter().position(|byte| *byte == 0).unwrap_or(data.len());
    let (node, ele) = data.split_at(cut);
    scratch::put("m.ele", ele.get(1..).unwrap_or(&[]));
    check("node", node);
}

/// `.vtu`.
pub fn vtu(data: &[u8]) {
    check("vtu", data);
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
