use super::*;
use crate::geometry::DVec2;
use crate::mesh::Piece;
use std::fs;

/// Two triangles of two regions over coordinates that have no short decimal form.
fn sample() -> Mesh {
    let third = 1.0 / 3.0;
    Mesh {
        points: [
            (0.0, 0.0),
            (third, 1e-9),
            (1e5 * third, 2.0),
            (-third, 0.1 + 0.2),
            (0.0, 1.0),
        ]
        .map(|(x, y)| DVec2::new(x, y))
        .to_vec(),
        point_markers: vec![1, -2, 0, 7, 0],
        triangles: vec![[0, 1, 2], [0, 2, 3], [0, 4, 3]],
        regions: vec![0.0, 2.5, -1.0],
        pieces: vec![Piece { a: 0, b: 1, segment: 0 }, Piece { a: 1, b: 2, segment: 0 }],
        piece_markers: vec![5, 5],
        input_vertices: 3,
        forced_pieces: 1,
        seams: vec![1],
    }
}

fn round_trip(name: &str) -> Mesh {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    write(&sample(), &path).unwrap();
    read(&path).unwrap()
}

#[test]
fn json_keeps_everything() {
    assert_eq!(round_trip("m.json"), sample());
}

/// Found by fuzzing: read to the nearest double only with serde_json's `float_roundtrip`.
#[test]
fn json_keeps_the_last_bit() {
    let mut mesh = sample();
    mesh.points[4].y = 1.3574372924521165;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.json");
    write(&mesh, &path).unwrap();
    assert_eq!(read(&path).unwrap().points, mesh.points);
}

#[test]
fn node_and_vtu_keep_markers_and_regions() {
    let bare = Mesh {
        pieces: vec![],
        piece_markers: vec![],
        input_vertices: 0,
        forced_pieces: 0,
        seams: vec![],
        ..sample()
    };
    assert_eq!(round_trip("m.node"), bare);
    assert_eq!(round_trip("m.ele"), bare);
    assert_eq!(round_trip("m.vtu"), bare);
}

#[test]
fn obj_keeps_geometry() {
    let mesh = round_trip("m.obj");
    assert_eq!((mesh.points, mesh.triangles), (sample().points, sample().triangles));
}

#[test]
fn msh_keeps_geometry_and_regions() {
    let mesh = round_trip("m.msh");
    assert_eq!(mesh.points, sample().points);
    // Gmsh keeps elements by entity: triangles come back in the order of their regions.
    assert_eq!(mesh.triangles, [[0, 4, 3], [0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.regions, [-1.0, 0.0, 2.5]);
}

#[test]
fn svg_draws_every_edge_once() {
    let text = svg::text(&sample());
    assert_eq!(text.matches('M').count(), 7 + 2, "{text}");
    assert!(svg::text(&Mesh::default()).ends_with("</svg>\n"));
}

#[test]
fn endings_choose_formats() {
    assert_eq!(Format::of(Path::new("a/b.VTU")), Some(Format::Vtu));
    let folder = tempfile::tempdir().unwrap();
    let error = write(&sample(), &folder.path().join("mesh.stl"))
        .unwrap_err()
        .to_string();
    assert!(error.contains("mesh.stl") && error.contains(".vtu"), "{error}");
    let error = read(Path::new("drawing.svg")).unwrap_err().to_string();
    assert!(error.contains("no mesh format") && !error.contains(".svg,"), "{error}");
    assert!(matches!(read(Path::new("absent.obj")), Err(MeshFileError::Io { .. })));
}

/// Writes `text` as a file and gives the complaint of reading it, without the folder.
fn complaint(name: &str, text: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    if name.ends_with(".ele") {
        fs::write(
            path.with_extension("node"),
            "# one triangle\n3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n",
        )
        .unwrap();
    }
    fs::write(&path, text).unwrap();
    let message = read(&path).unwrap_err().to_string();
    message.rsplit('/').next().unwrap_or_default().to_string()
}

#[test]
fn bad_files_are_told_by_line() {
    for (name, text, expected) in [
        (
            "m.node",
            "2 2 0 0\n0 0 0\n2 1 0\n",
            "m.node:3: vertex 2 where 1 should follow",
        ),
        (
            "m.node",
            "2 2 0 0\n0 0 0\n1 1\n",
            "m.node:4: expected coordinate, but the file ends",
        ),
        ("m.node", "1 2 0 0\n0 x 0\n", "m.node:2: expected coordinate, found `x`"),
        ("m.node", "1 2 0 0\n0 nan 0\n", "m.node:2: coordinate NaN is not finite"),
        (
            "m.node",
            "1 3 0 0\n0 0 0 0\n",
            "m.node:1: dimension 3 where 2 is needed",
        ),
        (
            "m.ele",
            "1 3 0\n1 1 2 4 # no such vertex\n",
            "m.ele:2: there is no vertex 4",
        ),
        ("m.ele", "1 2 0\n1 1 2\n", "m.ele:1: 2 nodes per triangle"),
        (
            "m.obj",
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
            "m.obj:5: a face of 4 corners is not a triangle",
        ),
        (
            "m.obj",
            "v 0 0 0\nf 1 1 2\n",
            "m.obj:2: `2` names no vertex above this line",
        ),
        (
            "m.msh",
            "$MeshFormat\n4.0 0 8\n$EndMeshFormat\n",
            "m.msh:2: version `4.0`: save the file as 4.1 or 2.2",
        ),
        (
            "m.msh",
            "$MeshFormat\n2.2 1 8\n$EndMeshFormat\n",
            "m.msh:2: file type 1 is binary: save the file as ASCII",
        ),
        (
            "m.vtu",
            "<VTKFile/>\n",
            "m.vtu:1: no data array in an element Points: not a .vtu file",
        ),
        (
            "m.vtu",
            "<Points>\n<DataArray Name=\"P\" format=\"binary\">\n",
            "m.vtu:2: P is stored as `binary`: save the file as ASCII",
        ),
        (
            "m.json",
            "{\n\"points\": 3}",
            "m.json:2: not a mesh: invalid type: integer `3`, expected a sequence at line 2 column 11",
        ),
    ] {
        let found = complaint(name, text);
        // A missing data array has no line of its own; whichever comes first is reported.
        assert!(
            found == expected || found.contains(expected),
            "{found}\nexpected {expected}"
        );
    }
}

#[test]
fn counts_from_one_and_further_nodes_are_understood() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.ele");
    fs::write(
        path.with_extension("node"),
        "4 2 1 1\n1 0 0 9 5\n2 1 0 9 5\n\n3 0 1 9 6\n4 .5 0 9 6\n",
    )
    .unwrap();
    fs::write(&path, "# six nodes\n1 6 2\n1 1 2 3 4 4 4 2.5 7\n").unwrap();
    let mesh = read(&path).unwrap();
    assert_eq!((mesh.triangles, mesh.regions), (vec![[0, 1, 2]], vec![2.5]));
    assert_eq!(mesh.point_markers, [5, 5, 6, 6]);
}

#[test]
fn obj_of_other_programs_is_understood() {
    let mesh = obj::parse(
        "# made elsewhere\nmtllib a.mtl\nv 0 0 5\nv 1 0 5 1.0\nvn 0 0 1\nv 0 1 5\nf 1/1 2/2/2 -1//3\nl 1 2\n",
    );
    let mesh = mesh.unwrap();
    assert_eq!((mesh.points.len(), mesh.triangles), (3, vec![[0, 1, 2]]));
}

#[test]
fn gmsh_2_is_understood() {
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 3 \"region_0.5\"\n$EndPhysicalNames\n\
        $Nodes\n3\n10 0 0 0\n20 1 0 0\n30 0 1 0\n$EndNodes\n\
        $Elements\n3\n1 15 2 1 1 10\n2 1 2 1 1 10 20\n3 2 2 3 1 10 20 30\n$EndElements\n";
    let mesh = gmsh::parse(text).unwrap();
    assert_eq!((mesh.triangles, mesh.regions), (vec![[0, 1, 2]], vec![0.5]));
}

#[test]
fn gmsh_parameters_beyond_counting_do_not_overflow() {
    let largest = usize::MAX;
    let text = format!(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 1 1 1\n{largest} 1 {largest} 1\n1\n0 0 0\n$EndNodes\n"
    );
    assert!(gmsh::parse(&text).is_err());
}

proptest::proptest! {
    /// Words of the formats in any order, with numbers that are too large, negative or none.
    #[test]
    fn no_text_makes_the_readers_panic(
        words in proptest::collection::vec(
            proptest::sample::select(vec![
                "0", "1", "2", "3", "-1", "5", "1e400", "99999999999999999999", "-9223372036854775808", "4294967295", ".5",
                "v", "f", "1/2", "#", "\n", "é", "4.1", "2.2", "8", "$MeshFormat", "$EndMeshFormat", "$Nodes", "$EndNodes",
                "$Elements", "$EndElements", "$Entities", "<Points>", "<Cells>", "<DataArray Name=\"types\">", "</",
                "<DataArray Name=\"connectivity\" format='ascii'>", "<DataArray Name=\"offsets\">", "<DataArray", ">", "\"",
                "{\"points\":[", "]", "}",
            ]),
            0..80,
        ),
    ) {
        let text = words.join(" ");
        let formatted = format!("$MeshFormat 4.1 0 8 $EndMeshFormat {text}");
        let node = triangle::parse_node(&text);
        let mut mesh = node.map_or_else(|_| Mesh::default(), |(mesh, _)| mesh);
        let _ = triangle::parse_ele(&text, &mut mesh, 1);
        for parse in [vtu::parse, gmsh::parse, obj::parse, json::parse] {
            let _ = parse(&text);
            let _ = parse(&formatted);
        }
    }
}
