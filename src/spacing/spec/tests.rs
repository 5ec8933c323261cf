//! What reads, what is refused and where.

use crate::spacing::spec::*;

#[test]
fn every_kind_reads_back_as_it_is_written() {
    for (text, canonical) in [
        ("lfs", "lfs"),
        (" lfs:geodesic", "lfs:geodesic"),
        ("min(uniform:1,lfs:geodesic )", "min(uniform:1, lfs:geodesic)"),
        (" uniform: 0.10 ", "uniform:0.1"),
        ("expr: 0.1+min(x, y) ", "expr:0.1+min(x, y)"),
        ("min( lfs,uniform:2)", "min(lfs, uniform:2)"),
        ("hessian: x^2*y ; eps = 1e-3", "hessian:x^2*y;eps=0.001"),
        ("hessian:x;max=2;eps=1;min=1", "hessian:x;eps=1;min=1;max=2"),
        ("field:u.vtu;min=1;eps=2", "field:u.vtu;eps=2;min=1"),
        ("el: old mesh.vtu", "el:old mesh.vtu"),
        (
            "points:sizes.node; alpha=0.3;factor=2",
            "points:sizes.node;factor=2;alpha=0.3",
        ),
        ("min(nn:a.node;factor=0.50, lfs)", "min(nn:a.node;factor=0.5, lfs)"),
        ("min(lfs,hessian:max(x,y);eps=1)", "min(lfs, hessian:max(x,y);eps=1)"),
        (
            "min(lfs, expr:min(x,y), min(lfs,uniform:1))",
            "min(lfs, expr:min(x,y), min(lfs, uniform:1))",
        ),
    ] {
        let spec = Spec::parse(text).unwrap();
        assert_eq!(spec.to_string(), canonical);
        assert_eq!(Spec::parse(canonical).unwrap(), spec);
    }
}

#[test]
fn errors_say_the_column_or_the_kinds() {
    let error = |text: &str| Spec::parse(text).unwrap_err().to_string();
    assert_eq!(
        error("min(lfs, lfs:geodesic)"),
        "spacing `min(lfs, lfs:geodesic)`, column 10: lfs:geodesic is nowhere below lfs; leave one of them out"
    );
    assert_eq!(
        error("uniform:-1"),
        "spacing `uniform:-1`, column 9: a positive number expected after `uniform:`"
    );
    assert_eq!(
        error("min(lfs, expr:x+*y)"),
        "spacing `min(lfs, expr:x+*y)`, column 17: a number, x, y or a function expected, found `*`"
    );
    assert_eq!(
        error("curvature:x^2"),
        format!("spacing `curvature:x^2` is unknown; there are {}", KINDS.join(", "))
    );
    assert_eq!(
        error("min(uniform:1, gns:field:u.vtu;eps=1)"),
        "spacing `min(uniform:1, gns:field:u.vtu;eps=1)`, column 16: write SPEC in place of gns:SPEC, since every spacing is capped by \
         lfs; where that cap is lifted, min(lfs, SPEC)"
    );
    assert!(error("min(lfs, lfs").ends_with("column 13: `)` expected to end `min(`"));
    assert!(error("min(lfs)").ends_with("column 8: `min` takes two or more"));
    assert!(error("min(lfs, lfs) + 1").ends_with("column 14: nothing expected after `min(…)`"));
}

#[test]
fn min_in_min_without_end_does_not_overflow_the_stack() {
    let nested = |depth: usize| format!("{}lfs{}", "min(lfs,".repeat(depth), ")".repeat(depth));
    assert!(Spec::parse(&nested(NESTING)).is_ok());
    for depth in [NESTING + 1, 100_000] {
        let error = Spec::parse(&nested(depth)).unwrap_err().to_string();
        assert!(error.ends_with("column 513: `min` is nested too deeply"));
    }
}

#[test]
fn min_may_have_any_number_of_mins_beside_one_another() {
    let many = format!("min({})", vec!["min(lfs, lfs)"; 10 * NESTING].join(", "));
    assert!(matches!(Spec::parse(&many), Ok(Spec::Min(parts)) if parts.len() == 10 * NESTING));
    assert!(Spec::parse(&format!("min(lfs, {many})")).is_ok());
}

#[test]
fn a_size_is_divided_by_c_b() {
    assert_eq!(spec_for_size(" 0.1+x ", 0.5).unwrap(), "expr:(0.1+x)/0.5");
    let error = spec_for_size("0.1+", 0.5).unwrap_err().to_string();
    assert_eq!(
        error,
        "spacing `0.1+`, column 5: a number, x, y or a function expected, found the end"
    );
}

#[test]
fn columns_count_characters_from_the_start_of_the_whole() {
    let error = |text: &str| Spec::parse(text).unwrap_err().to_string();
    for (text, column, message) in [
        ("  uniform:0", 11, "a positive number expected after `uniform:`"),
        ("uniform:inf", 9, "a positive number expected after `uniform:`"),
        ("uniform:nan", 9, "a positive number expected after `uniform:`"),
        ("uniform:", 9, "a positive number expected after `uniform:`"),
        ("expr:x+*y", 8, "a number, x, y or a function expected, found `*`"),
        (" expr: 1+", 10, "a number, x, y or a function expected, found the end"),
        ("min(lfs, uniform:x)", 18, "a positive number expected after `uniform:`"),
        ("min(expr:x §, lfs)", 12, "`§` has no meaning here"),
        ("min (lfs)", 9, "`min` takes two or more"),
        ("min(lfs, min(lfs))", 17, "`min` takes two or more"),
        ("min(lfs, lfs) ;", 14, "nothing expected after `min(…)`"),
        (" min(lfs, lfs", 14, "`)` expected to end `min(`"),
        ("min(lfs, expr:(x)", 18, "`)` expected to end `min(`"),
        (
            "hessian:x^2",
            12,
            "`;eps=E` expected: the error of linear interpolation that is allowed, in the unit of u",
        ),
        (
            "hessian:x^;eps=1",
            11,
            "a number, x, y or a function expected, found the end",
        ),
        ("min(hessian:x+§;eps=1, lfs)", 15, "`§` has no meaning here"),
        ("field:;eps=1", 7, "a file expected"),
        ("field:u.vtu;eps=0", 17, "a positive number expected after `eps=`"),
        ("el: ;factor=2", 4, "a file expected"),
        ("nn:a.vtu;factor=0", 17, "a positive number expected after `factor=`"),
        ("hessian:x;eps=-1", 15, "a positive number expected after `eps=`"),
        (
            "hessian:x;eps=1;size=2",
            17,
            "`size` is unknown here; there are eps, min, max",
        ),
        ("min(lfs, hessian:x;eps=1;min=3;max=2)", 19, "min = 3 is above max = 2"),
    ] {
        assert_eq!(error(text), format!("spacing `{text}`, column {column}: {message}"));
    }
    for (text, kind) in [
        ("", ""),
        ("min", "min"),
        ("min(lfs,, lfs)", ""),
        ("min(lfs, LFS)", "LFS"),
        ("minimum(lfs, lfs)", "minimum(lfs, lfs)"),
    ] {
        let told = Spec::parse(text).unwrap_err();
        assert!(
            matches!(&told, SpacingError::UnknownKind { kind: found, .. } if found == kind),
            "{text}: {told}"
        );
    }
}

#[test]
fn a_spec_is_capped_where_lfs_is_a_part_of_it() {
    for (text, is_capped) in [
        ("lfs", true),
        ("uniform:1", false),
        ("expr:x", false),
        ("min(uniform:1, expr:x)", false),
        ("min(uniform:1, lfs)", true),
        ("min(uniform:1, min(expr:x, lfs))", true),
        ("hessian:x;eps=1", false),
        ("min(lfs, hessian:x;eps=1)", true),
    ] {
        assert_eq!(Spec::parse(text).unwrap().is_capped(), is_capped, "{text}");
    }
}

#[test]
fn commas_and_parentheses_of_expressions_are_their_own() {
    let spec = Spec::parse(" min ( expr:max(x, (y)), min(lfs, uniform:2 ) , expr:(x)*(y) )").unwrap();
    let expression = |text: &str| Spec::Expression(text.to_owned());
    let inner = Spec::Min(vec![Spec::Lfs, Spec::Uniform(2.0)]);
    assert_eq!(
        spec,
        Spec::Min(vec![expression("max(x, (y))"), inner, expression("(x)*(y)")])
    );
}
