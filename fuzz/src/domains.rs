//! Readers of domains: what they read is validated, repaired where it is faulty, and located in.

use biting::domain::{Domain, DomainError, Pslg, parse_geojson, parse_poly, repair};

/// A `.poly` file; after a zero byte the `.node` file beside it.
pub fn poly(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    let (poly, node) = text.split_once('\0').unwrap_or((&text, ""));
    check(parse_poly(poly, "fuzz.poly", || {
        Ok((node.to_owned(), "fuzz.node".to_owned()))
    }));
}

/// A GeoJSON file.
pub fn geojson(data: &[u8]) {
    check(parse_geojson(&String::from_utf8_lossy(data), "fuzz.geojson"));
}

fn check(read: Result<Pslg, DomainError>) {
    let domain = match read.and_then(|pslg| Domain::new(pslg.clone()).or_else(|_| Domain::new(repair(pslg).0))) {
        Ok(domain) => domain,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    assert!(domain.area().is_finite() && domain.area() >= 0.0);
    for vertex in domain.vertices() {
        assert!(domain.contains(*vertex), "a vertex of a domain lies in it");
    }
}
