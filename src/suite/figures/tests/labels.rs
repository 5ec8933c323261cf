//! No label on another, on a point, or outside its picture.

use super::super::FIGURES;
use super::super::drawing::Picture;
use super::material;
use crate::geometry::Rect;

fn overlap(a: &Rect, b: &Rect) -> bool {
    a.min.cmplt(b.max).all() && b.min.cmplt(a.max).all()
}

#[test]
fn no_label_collides() {
    let mut labels_seen = 0;
    for entry in FIGURES.iter().filter(|entry| entry.name.starts_with("figure")) {
        let drawing = (entry.draw)(material()).unwrap();
        let Picture::Sheet(sheet) = &drawing.picture else {
            panic!("{} is no sheet", entry.name);
        };
        for ((frame, labels, points), scene) in sheet.placed().iter().zip(&sheet.scenes) {
            assert_eq!(labels.len(), scene.labels.len());
            labels_seen += labels.len();
            for (k, label) in labels.iter().enumerate() {
                let words = format!("{} {}: {}", entry.name, scene.title, scene.labels[k].words);
                assert!(
                    labels[..k].iter().all(|other| !overlap(label, other)),
                    "{words} on a label"
                );
                assert!(points.iter().all(|point| !overlap(label, point)), "{words} on a point");
                assert!(
                    frame.contains(label.min) && frame.contains(label.max),
                    "{words} outside"
                );
            }
        }
    }
    assert!(labels_seen > 20, "{labels_seen}");
}
