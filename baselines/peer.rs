//! The protocol of PROTOCOL.md for programs in Rust: request, domain, mesh, answer.

use serde_json::{Map, Value, json};
use std::fmt::Write;
use std::fs;
use std::process::ExitCode;
use std::time::Instant;

const DECLINED: u8 = 4;

/// Why there is no mesh.
pub enum Failure {
    /// The peer cannot take this input.
    Declined(String),
    /// Anything else.
    Failed(String),
}

impl From<String> for Failure {
    fn from(message: String) -> Self {
        Failure::Failed(message)
    }
}

/// A planar straight-line graph: a point in each hole.
pub struct Domain {
    pub points: Vec<[f64; 2]>,
    pub segments: Vec<[usize; 2]>,
    pub holes: Vec<[f64; 2]>,
}

/// What edge length is asked for. Neither of the peers that use this file takes a field, so none is read.
pub enum Size {
    AnglesAlone,
    Uniform(f64),
    Field,
}

/// The area of the equilateral triangle with such edges.
pub fn equilateral_area(edge: f64) -> f64 {
    3f64.sqrt() / 4.0 * edge * edge
}

#[derive(Default)]
pub struct Mesh {
    pub points: Vec<[f64; 2]>,
    pub triangles: Vec<[usize; 3]>,
    /// Numbers that the peer reports of itself.
    pub counts: Map<String, Value>,
}

impl Mesh {
    /// The mesh of these triangles; points that are in none of them are left out.
    pub fn compacted(
        triangles: impl Iterator<Item = [usize; 3]>,
        point: impl Fn(usize) -> [f64; 2],
        points: usize,
    ) -> Mesh {
        let mut mesh = Mesh::default();
        let mut index = vec![None; points];
        for triangle in triangles {
            mesh.triangles.push(triangle.map(|vertex| {
                *index[vertex].get_or_insert_with(|| {
                    mesh.points.push(point(vertex));
                    mesh.points.len() - 1
                })
            }));
        }
        mesh
    }
}

/// Answers the request named on the command line with what `mesh` makes of domain, size and the peer's one parameter,
/// the smallest angle in degrees.
pub fn serve(version: &str, mesh: impl Fn(&Domain, &Size, f64) -> Result<Mesh, Failure>) -> ExitCode {
    let (message, status) = match answer(version, mesh) {
        Ok(()) => return ExitCode::SUCCESS,
        Err(Failure::Declined(message)) => (message, DECLINED),
        Err(Failure::Failed(message)) => (message, 1),
    };
    eprintln!("{message}");
    ExitCode::from(status)
}

fn answer(version: &str, mesh: impl Fn(&Domain, &Size, f64) -> Result<Mesh, Failure>) -> Result<(), Failure> {
    let path = std::env::args().nth(1).ok_or("usage: PEER REQUEST.json".to_string())?;
    let start = Instant::now();
    let request: Value = serde_json::from_str(&read(&path)?).map_err(|error| format!("{path}: {error}"))?;
    let domain = read_domain(text(&request, "domain")?)?;
    let seconds_read = start.elapsed().as_secs_f64();

    let start = Instant::now();
    let size = match &request["size"] {
        Value::Null => Size::AnglesAlone,
        size => size["uniform"].as_f64().map_or(Size::Field, Size::Uniform),
    };
    let angle = request["parameters"]["angle"]
        .as_f64()
        .ok_or("no parameter \"angle\"".to_string())?;
    let seconds_size_field = start.elapsed().as_secs_f64();

    let before = memory_bytes("VmRSS:")?;
    let start = Instant::now();
    let found = mesh(&domain, &size, angle)?;
    let seconds_mesh = start.elapsed().as_secs_f64();
    let peak = memory_bytes("VmHWM:")?;

    write_mesh(text(&request, "mesh")?, &found)?;
    let answer = json!({
        "version": version,
        "seconds": {"imports": 0.0, "read": seconds_read, "size_field": seconds_size_field, "mesh": seconds_mesh},
        "rss_before_bytes": before,
        "peak_rss_bytes": peak,
        "counts": found.counts,
    });
    write(text(&request, "answer")?, answer.to_string())
}

fn text<'a>(request: &'a Value, field: &str) -> Result<&'a str, Failure> {
    Ok(request[field]
        .as_str()
        .ok_or(format!("the request has no \"{field}\""))?)
}

fn read(path: &str) -> Result<String, Failure> {
    Ok(fs::read_to_string(path).map_err(|error| format!("{path}: {error}"))?)
}

fn write(path: &str, content: String) -> Result<(), Failure> {
    Ok(fs::write(path, content).map_err(|error| format!("{path}: {error}"))?)
}

/// A `.poly` file counted from 0.
fn read_domain(path: &str) -> Result<Domain, Failure> {
    let content = read(path)?;
    let mut rows = content
        .lines()
        .map(|line| {
            line.split('#')
                .next()
                .unwrap_or_default()
                .split_whitespace()
                .collect::<Vec<_>>()
        })
        .filter(|row| !row.is_empty());
    let mut section = || -> Option<Vec<[&str; 2]>> {
        let count = rows.next()?.first()?.parse().ok()?;
        (0..count).map(|_| rows.next()?.get(1..3)?.try_into().ok()).collect()
    };
    let mut domain = || {
        Some(Domain {
            points: parse(section()?)?,
            segments: parse(section()?)?,
            holes: parse(section()?)?,
        })
    };
    Ok(domain().ok_or(format!("{path}: not a .poly file"))?)
}

fn parse<T: std::str::FromStr>(rows: Vec<[&str; 2]>) -> Option<Vec<[T; 2]>> {
    rows.into_iter()
        .map(|[a, b]| Some([a.parse().ok()?, b.parse().ok()?]))
        .collect()
}

fn write_mesh(stem: &str, mesh: &Mesh) -> Result<(), Failure> {
    let mut nodes = format!("{} 2 0 0\n", mesh.points.len());
    for (k, [x, y]) in mesh.points.iter().enumerate() {
        let _ = writeln!(nodes, "{k} {x:?} {y:?}");
    }
    let mut elements = format!("{} 3 0\n", mesh.triangles.len());
    for (k, [a, b, c]) in mesh.triangles.iter().enumerate() {
        let _ = writeln!(elements, "{k} {a} {b} {c}");
    }
    write(&format!("{stem}.node"), nodes)?;
    write(&format!("{stem}.ele"), elements)
}

/// Resident memory of this process now (`VmRSS:`) or at its peak (`VmHWM:`).
fn memory_bytes(field: &str) -> Result<u64, Failure> {
    let status = read("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix(field));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    Ok(1024 * kilobytes.ok_or(format!("/proc/self/status has no {field}"))?)
}
