//! `.msh`: Gmsh's format, written as 4.1 and read as 4.1 or 2.2, all ASCII.
//! Reference: Gmsh reference manual, "MSH file format".
//!
//! Each marker of segments becomes a physical curve `marker_M`, each region a physical surface `region_R`.

use super::scan::{Complaint, Words};
use crate::geometry::{DVec2, Rect};
use crate::mesh::Mesh;
use std::collections::{BTreeMap, HashMap};
use std::fmt::Write;

/// Gmsh's element types.
const LINE: usize = 1;
const TRIANGLE: usize = 2;
const POINT: usize = 15;

/// Version 4.1: physical names, an entity for each marker and each region, nodes, lines and triangles.
pub fn text(mesh: &Mesh) -> String {
    let curves = Groups::of(&mesh.piece_markers);
    let surfaces = Groups::of(
        &mesh
            .regions
            .iter()
            .map(|region| TotalOrder(*region))
            .collect::<Vec<_>>(),
    );
    let mut text = String::from("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n");
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{}", curves.members.len() + surfaces.members.len());
    for (tag, marker) in (1..).zip(curves.members.keys()) {
        let _ = writeln!(text, "1 {tag} \"marker_{marker}\"");
    }
    for (tag, region) in (1..).zip(surfaces.members.keys()) {
        let _ = writeln!(text, "2 {tag} \"region_{:?}\"", region.0);
    }
    let _ = writeln!(
        text,
        "$EndPhysicalNames\n$Entities\n0 {} {} 0",
        curves.members.len(),
        surfaces.members.len()
    );
    let bounds = Rect::around(mesh.points.iter().copied());
    for tag in (1..=curves.members.len()).chain(1..=surfaces.members.len()) {
        let Rect { min, max } = bounds;
        let _ = writeln!(
            text,
            "{tag} {:?} {:?} 0 {:?} {:?} 0 1 {tag} 0",
            min.x, min.y, max.x, max.y
        );
    }
    text.push_str("$EndEntities\n");
    nodes(&mut text, mesh);
    elements(&mut text, mesh, &curves, &surfaces);
    text
}

fn nodes(text: &mut String, mesh: &Mesh) {
    let count = mesh.points.len();
    let _ = writeln!(text, "$Nodes\n1 {count} 1 {count}\n2 1 0 {count}");
    for tag in 1..=count {
        let _ = writeln!(text, "{tag}");
    }
    for p in &mesh.points {
        let _ = writeln!(text, "{:?} {:?} 0", p.x, p.y);
    }
    text.push_str("$EndNodes\n");
}

fn elements(text: &mut String, mesh: &Mesh, curves: &Groups<i32>, surfaces: &Groups<TotalOrder>) {
    let blocks = curves.members.len() + surfaces.members.len();
    let count = mesh.pieces.len() + mesh.triangles.len();
    let _ = writeln!(text, "$Elements\n{blocks} {count} 1 {count}");
    let mut element = 1..;
    for (tag, members) in (1..).zip(curves.members.values()) {
        let _ = writeln!(text, "1 {tag} {LINE} {}", members.len());
        for (piece, element) in members.iter().map(|k| mesh.pieces[*k]).zip(&mut element) {
            let _ = writeln!(text, "{element} {} {}", piece.a + 1, piece.b + 1);
        }
    }
    for (tag, members) in (1..).zip(surfaces.members.values()) {
        let _ = writeln!(text, "2 {tag} {TRIANGLE} {}", members.len());
        for ([a, b, c], element) in members.iter().map(|k| mesh.triangles[*k]).zip(&mut element) {
            let _ = writeln!(text, "{element} {} {} {}", a + 1, b + 1, c + 1);
        }
    }
    text.push_str("$EndElements\n");
}

/// Indices by the value they share, in the order of the values.
struct Groups<K> {
    members: BTreeMap<K, Vec<usize>>,
}

impl<K: Ord + Copy> Groups<K> {
    fn of(values: &[K]) -> Self {
        let mut members: BTreeMap<K, Vec<usize>> = BTreeMap::new();
        for (k, value) in values.iter().enumerate() {
            members.entry(*value).or_default().push(k);
        }
        Self { members }
    }
}

/// A double ordered by [`f64::total_cmp`].
#[derive(Clone, Copy)]
struct TotalOrder(f64);

impl PartialEq for TotalOrder {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for TotalOrder {}

impl PartialOrd for TotalOrder {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for TotalOrder {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// Points without their z, and triangles; elements that are points or lines are skipped, others refused.
pub fn parse(text: &str) -> Result<Mesh, Complaint> {
    let mut reader = Reader {
        words: Words::new(text, 1, false),
        ..Reader::new()
    };
    while let Some(section) = reader.words.next() {
        match section {
            "$MeshFormat" => reader.format()?,
            "$PhysicalNames" => reader.physical_names()?,
            "$Entities" => reader.entities()?,
            "$Nodes" if reader.modern => reader.nodes()?,
            "$Nodes" => reader.old_nodes()?,
            "$Elements" if reader.modern => reader.elements()?,
            "$Elements" => reader.old_elements()?,
            _ => {}
        }
        reader.skip_to_end(section)?;
    }
    let mut mesh = reader.mesh;
    mesh.point_markers = vec![0; mesh.points.len()];
    Ok(mesh)
}

/// What has been read so far.
struct Reader<'a> {
    words: Words<'a>,
    /// Whether the file is of version 4.1, not 2.2.
    modern: bool,
    /// Index of the node with each tag; only looked up, never listed.
    node: HashMap<u64, u32>,
    /// Region of each physical surface that has a name of ours, by tag.
    named_region: BTreeMap<i64, f64>,
    /// Physical tag of each surface, by tag.
    surface_group: BTreeMap<i64, i64>,
    mesh: Mesh,
}

impl Reader<'_> {
    fn new() -> Self {
        Self {
            words: Words::new("", 1, false),
            modern: true,
            node: HashMap::new(),
            named_region: BTreeMap::new(),
            surface_group: BTreeMap::new(),
            mesh: Mesh::default(),
        }
    }

    fn skip_to_end(&mut self, section: &str) -> Result<(), Complaint> {
        let end = section.replacen('$', "$End", 1);
        loop {
            match self.words.next() {
                Some(word) if word == end => return Ok(()),
                Some(_) => {}
                None => return Err(self.words.complain(format!("the file ends before {end}"))),
            }
        }
    }

    fn format(&mut self) -> Result<(), Complaint> {
        let version = self.words.next().unwrap_or("");
        self.modern = match version {
            "4.1" => true,
            "2.2" => false,
            _ => {
                return Err(self
                    .words
                    .complain(format!("version `{version}`: save the file as 4.1 or 2.2")));
            }
        };
        match self.words.number("file type")? {
            0 => Ok(()),
            kind => Err(self
                .words
                .complain(format!("file type {kind} is binary: save the file as ASCII"))),
        }
    }

    fn physical_names(&mut self) -> Result<(), Complaint> {
        for _ in 0..self.words.number("number of names")? {
            let dimension: usize = self.words.number("dimension")?;
            let tag = self.words.number("physical tag")?;
            let name: Vec<&str> = self.words.finish_line().collect();
            let region = name
                .concat()
                .trim_matches('"')
                .strip_prefix("region_")
                .and_then(|value| value.parse().ok());
            if let (2, Some(region)) = (dimension, region) {
                self.named_region.insert(tag, region);
            }
        }
        Ok(())
    }

    fn entities(&mut self) -> Result<(), Complaint> {
        let mut counts = [0usize; 4];
        for count in &mut counts {
            *count = self.words.number("number of entities")?;
        }
        for (dimension, count) in counts.into_iter().enumerate().take(3) {
            for _ in 0..count {
                let tag = self.words.number("entity tag")?;
                for _ in 0..if dimension == 0 { 3 } else { 6 } {
                    self.words.coordinate()?;
                }
                let groups: usize = self.words.number("number of physical tags")?;
                let first = self.words.finish_line().next().and_then(|group| group.parse().ok());
                if let (2, true, Some(group)) = (dimension, groups > 0, first) {
                    self.surface_group.insert(tag, group);
                }
            }
        }
        Ok(())
    }

    fn add_node(&mut self, tag: u64) -> Result<(), Complaint> {
        let p = DVec2::new(self.words.coordinate()?, self.words.coordinate()?);
        self.words.coordinate()?;
        if self.node.insert(tag, self.mesh.points.len() as u32).is_some() {
            return Err(self.words.complain(format!("node {tag} is there twice")));
        }
        self.mesh.points.push(p);
        Ok(())
    }

    fn nodes(&mut self) -> Result<(), Complaint> {
        let blocks: usize = self.words.number("number of blocks")?;
        self.words.skip_line();
        for _ in 0..blocks {
            let dimension: usize = self.words.number("dimension")?;
            self.words.number::<i64>("entity tag")?;
            let parametric: usize = self.words.number("parametric flag")?;
            let count: usize = self.words.number("number of nodes")?;
            let mut tags = Vec::new();
            for _ in 0..count {
                tags.push(self.words.number("node tag")?);
            }
            for tag in tags {
                self.add_node(tag)?;
                for _ in 0..parametric.saturating_mul(dimension) {
                    self.words.number::<f64>("parameter")?;
                }
            }
        }
        Ok(())
    }

    fn old_nodes(&mut self) -> Result<(), Complaint> {
        for _ in 0..self.words.number("number of nodes")? {
            let tag = self.words.number("node tag")?;
            self.add_node(tag)?;
        }
        Ok(())
    }

    /// One element after its type and tags: a triangle is kept, points and lines are skipped.
    fn add_element(&mut self, kind: usize, region: f64) -> Result<(), Complaint> {
        match kind {
            TRIANGLE => {
                let mut corners = [0; 3];
                for corner in &mut corners {
                    let tag: u64 = self.words.number("node tag")?;
                    let node = self.node.get(&tag).copied();
                    *corner = node.ok_or_else(|| self.words.complain(format!("there is no node {tag}")))?;
                }
                self.mesh.triangles.push(corners);
                self.mesh.regions.push(region);
                Ok(())
            }
            LINE | POINT => {
                self.words.skip_line();
                Ok(())
            }
            _ => Err(self
                .words
                .complain(format!("an element of Gmsh type {kind} is not a triangle"))),
        }
    }

    fn region(&self, group: i64) -> f64 {
        self.named_region.get(&group).copied().unwrap_or(group as f64)
    }

    fn elements(&mut self) -> Result<(), Complaint> {
        let blocks: usize = self.words.number("number of blocks")?;
        self.words.skip_line();
        for _ in 0..blocks {
            self.words.number::<usize>("dimension")?;
            let entity: i64 = self.words.number("entity tag")?;
            let kind = self.words.number("element type")?;
            let count: usize = self.words.number("number of elements")?;
            let region = self.surface_group.get(&entity).map_or(0.0, |group| self.region(*group));
            for _ in 0..count {
                self.words.number::<u64>("element tag")?;
                self.add_element(kind, region)?;
            }
        }
        Ok(())
    }

    fn old_elements(&mut self) -> Result<(), Complaint> {
        for _ in 0..self.words.number("number of elements")? {
            self.words.number::<u64>("element tag")?;
            let kind = self.words.number("element type")?;
            let tags: usize = self.words.number("number of tags")?;
            let mut group = 0;
            for k in 0..tags {
                let tag = self.words.number("tag")?;
                group = if k == 0 { tag } else { group };
            }
            let region = self.region(group);
            self.add_element(kind, region)?;
        }
        Ok(())
    }
}
