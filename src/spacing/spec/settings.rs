//! `ARGUMENT;name=value;…`: what follows the colon of a SPEC that has settings.

/// A value of a SPEC's setting: positive and finite.
pub type Value = Option<f64>;

/// What is wrong, and at which byte.
pub type Fault = (usize, String);

/// The argument in front of the settings with one value for each of `names`, in their order.
///
/// # Errors
/// Names that are unknown or given twice, values that are not positive numbers.
pub fn read<'a, const N: usize>(text: &'a str, names: [&str; N]) -> Result<(&'a str, [Value; N]), Fault> {
    let mut values = [None; N];
    let argument = text.split(';').next().unwrap_or_default();
    let mut start = argument.len() + 1;
    for setting in text.split(';').skip(1) {
        let (name, value) = setting.split_once('=').unwrap_or((setting, ""));
        let blanks = name.len() - name.trim_start().len();
        let place = names.iter().position(|known| *known == name.trim());
        let Some(place) = place else {
            let told = format!("`{}` is unknown here; there are {}", name.trim(), names.join(", "));
            return Err((start + blanks, told));
        };
        if values[place].is_some() {
            return Err((start + blanks, format!("`{}` is given twice", names[place])));
        }
        let number = value.trim().parse().ok();
        values[place] = number.filter(|value: &f64| value.is_finite() && *value > 0.0);
        if values[place].is_none() {
            let told = format!("a positive number expected after `{}=`", names[place]);
            return Err(((start + name.len() + 1).min(text.len()), told));
        }
        start += setting.len() + 1;
    }
    Ok((argument, values))
}

/// The settings that are given, as they are read back.
pub fn text(settings: &[(&str, Value)]) -> String {
    let given = settings
        .iter()
        .filter_map(|(name, value)| value.map(|value| format!(";{name}={value}")));
    given.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_read_by_name_and_written_back() {
        let (argument, values) = read("x^2 ; eps = 1e-3;max=2", ["eps", "min", "max"]).unwrap();
        assert_eq!((argument, values), ("x^2 ", [Some(1e-3), None, Some(2.0)]));
        assert_eq!(read("x", ["eps"]), Ok(("x", [None])));
        assert_eq!(
            text(&[("eps", Some(1e-3)), ("min", None), ("max", Some(2.0))]),
            ";eps=0.001;max=2"
        );
    }

    #[test]
    fn faults_say_where() {
        let fault = |text: &str| read(text, ["eps", "min"]).unwrap_err();
        assert_eq!(
            fault("x; big=1"),
            (3, "`big` is unknown here; there are eps, min".into())
        );
        assert_eq!(fault("x;eps=1;eps=2"), (8, "`eps` is given twice".into()));
        for (text, at) in [("x;eps=0", 6), ("x;eps", 5), ("x;min= nan", 6), ("x;eps=1;min=-1", 12)] {
            let (place, told) = fault(text);
            assert!(
                place == at && told.starts_with("a positive number expected after `"),
                "{text} {place} {told}"
            );
        }
    }
}
