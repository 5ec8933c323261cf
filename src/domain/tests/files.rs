//! Files: what is read, what is refused, what is written.

use crate::domain::files::{geojson, poly};
use crate::domain::{Domain, DomainError, Pslg, gallery, load};
use crate::geometry::DVec2;
use proptest::prelude::*;

fn no_node() -> Result<(String, String), DomainError> {
    Err(DomainError::Unreadable {
        file: "beside.node".to_owned(),
        message: "cannot be read".to_owned(),
    })
}

fn parse_poly(text: &str) -> Result<Pslg, DomainError> {
    poly::parse(text, "test.poly", no_node)
}

#[test]
fn a_poly_file_with_everything() {
    let text = "# a plate\n\n4 2 1 1 # attributes and markers\n1 0 0 9.5 5\n2, 1, 0, 9.5, 6\n3 1 1 9.5\n4 0 1 9.5 -7\n\
                4 1\n1 1 2 11\n2 2 3\n3 3 4 13\n4 4 1 14\n0\n2\n1 0.5 0.5 3.25 0.1\n2 0.25 0.5 -4\n";
    let pslg = parse_poly(text).unwrap();
    assert_eq!(pslg.vertex_markers, [5, 6, 0, -7]);
    assert_eq!(
        pslg.segments.iter().map(|s| (s.a, s.b, s.marker)).collect::<Vec<_>>(),
        [(0, 1, 11), (1, 2, 0), (2, 3, 13), (3, 0, 14)]
    );
    let regions: Vec<_> = pslg.regions.iter().map(|r| (r.attribute, r.max_area)).collect();
    assert_eq!(regions, [(3.25, Some(0.1)), (-4.0, None)]);
    assert_eq!(
        (
            pslg.source.vertex_lines[0],
            pslg.source.segment_lines[0],
            pslg.source.region_lines[1]
        ),
        (4, 9, 16)
    );
}

#[test]
fn vertices_may_stand_in_a_node_file_beside() {
    let node = || Ok(("3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n".to_owned(), "beside.node".to_owned()));
    let pslg = poly::parse("0 2 0 0\n3 0\n0 0 1\n1 1 2\n2 2 0\n0\n", "test.poly", node).unwrap();
    assert_eq!(Domain::new(pslg).unwrap().area(), 0.5);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tri.poly");
    std::fs::write(
        folder.path().join("tri.node"),
        "3 2 0 0\n1 0 0\n2 1 0\n3 0 1 # a corner\n",
    )
    .unwrap();
    std::fs::write(&path, "0 2 0 0\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n").unwrap();
    let domain = load(path.to_str().unwrap()).unwrap();
    assert_eq!((domain.area(), domain.name()), (0.5, "tri"));
}

#[test]
fn refusals_name_the_line() {
    let messages: Vec<String> = [
        "",
        "3 3 0 0\n",
        "3 2 0 0\n5 0 0\n",
        "3 2 0 0\n1 0 zero\n",
        "3 2 0 0\n1 0 0\n3 1 0\n",
        "99999999999 2 0 0\n1 0 0\n",
        "1 2 0 0\n1 0 0\n1 0\n1 0 1\n",
        "1 2 0 0\n1 0 0\n0 0\n0\n0\nmore\n",
        "0 2 0 0\n",
    ]
    .iter()
    .map(|text| parse_poly(text).unwrap_err().to_string())
    .collect();
    insta::assert_snapshot!(messages.join("\n"));
    let refused = |spec: &str| load(spec).unwrap_err().to_string();
    insta::assert_snapshot!(
        [
            refused("koch:n=3"),
            refused("no-such.poly"),
            refused("nonsense"),
            refused("Cargo.toml")
        ]
        .join("\n")
    );
}

#[test]
fn geojson_rings_make_holes_islands_and_common_borders() {
    let ring = |low: f64, high: f64| format!("[[{low},0],[{high},0],[{high},4],[{low},4],[{low},0]]");
    let text = format!(
        r#"{{"type": "FeatureCollection", "features": [
          {{"type": "Feature", "properties": {{"name": "[1, 2]"}}, "geometry": {{"type": "Polygon", "coordinates": [{}, [[1,1],[2,1],[2,2],[1,1]]]}}}},
          {{"type": "Feature", "properties": null, "geometry": {{"type": "MultiPolygon", "coordinates": [[{}]]}}}}
        ]}}"#,
        ring(0.0, 4.0),
        ring(4.0, 8.0)
    );
    let pslg = geojson::parse(&text, "test.geojson").unwrap();
    assert_eq!((pslg.vertices.len(), pslg.segments.len()), (6 + 3, 7 + 3));
    // The name in the properties looks like a position, so the lines are not known.
    assert!(pslg.source.vertex_lines.is_empty() || pslg.source.vertex_lines[0] == 2);
    let domain = Domain::new(pslg).unwrap();
    assert_eq!(domain.area(), 32.0 - 0.5);
    assert!(domain.contains(DVec2::new(4.0, 2.0)) && !domain.contains(DVec2::new(1.6, 1.4)));
    assert!((0..10).filter(|&s| !domain.is_boundary(s)).count() == 1);
}

#[test]
fn geojson_refusals_name_the_line() {
    let polygon = |rings: &str| format!("{{\"type\": \"Polygon\",\n \"coordinates\": [{rings}]}}");
    let messages: Vec<String> = [
        "{".to_owned(),
        "{\"type\": \"Point\", \"coordinates\": [1, 2]}".to_owned(),
        polygon("[[0,0],[1,0],\n[1,1],\n[0,1]]"),
        polygon("[[0,0],[1,0],[0,0]]"),
    ]
    .iter()
    .map(|text| geojson::parse(text, "test.geojson").unwrap_err().to_string())
    .collect();
    insta::assert_snapshot!(messages.join("\n"));
    let crossed = geojson::parse(&polygon("[[0,0],\n[1,0],\n[0,1],\n[1,1],\n[0,0]]"), "test.geojson").unwrap();
    insta::assert_snapshot!(Domain::new(crossed).unwrap_err());
}

#[test]
fn a_domain_written_as_poly_is_read_back_the_same() {
    insta::assert_snapshot!(gallery::domain("interface").unwrap().unwrap().to_poly());
    for entry in gallery::ENTRIES {
        let domain = gallery::domain(entry.name).unwrap().unwrap();
        let again = Domain::new(parse_poly(&domain.to_poly()).unwrap()).unwrap();
        assert_eq!(domain.vertices(), again.vertices(), "{}", entry.name);
        assert_eq!(domain.segments(), again.segments(), "{}", entry.name);
        assert_eq!(domain.faces(), again.faces(), "{}", entry.name);
        assert_eq!(domain.area(), again.area(), "{}", entry.name);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn no_text_makes_the_readers_panic(
        words in prop::collection::vec(prop_oneof!["[0-9]{1,3}", "[0-9]{9,22}", "-?[0-9]{1,2}\\.[0-9]", "nan|inf|#|\n|,", "\\PC{1,4}"], 0..80),
        bytes in prop::collection::vec(any::<u8>(), 0..200),
    ) {
        let texts = [words.join(" "), words.join("\n"), String::from_utf8_lossy(&bytes).into_owned()];
        for text in &texts {
            if let Ok(pslg) = parse_poly(text) {
                let _ = Domain::new(pslg);
            }
            let wrapped = format!("{{\"type\":\"Polygon\",\"coordinates\":[[[{}]]]}}", words.join(","));
            for text in [text, &wrapped] {
                if let Ok(pslg) = geojson::parse(text, "x") {
                    let _ = Domain::new(pslg);
                }
            }
        }
    }

    #[test]
    fn no_geojson_of_small_numbers_makes_the_reader_panic(
        ring in prop::collection::vec((0..4i32, 0..4i32), 0..12),
        nesting in prop::sample::select(vec!["Polygon", "MultiPolygon", "LineString", "Point"]),
    ) {
        let positions: Vec<String> = ring.iter().chain(ring.first()).map(|(x, y)| format!("[{x},{y}]")).collect();
        let joined = positions.join(",");
        for coordinates in [format!("[[{joined}]]"), format!("[[[{joined}]]]"), format!("[{joined}]"), joined] {
            let text = format!("{{\"type\":\"{nesting}\",\"coordinates\":{coordinates}}}");
            if let Ok(pslg) = geojson::parse(&text, "x") {
                let _ = Domain::new(crate::domain::repair(pslg).0);
            }
        }
    }
}
