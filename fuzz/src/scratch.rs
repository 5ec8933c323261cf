//! Files for readers that take a path: overwritten for every input, in a folder of this process.

use std::path::PathBuf;
use std::sync::OnceLock;

/// The path of the scratch file `name`, whose folder exists.
pub fn path(name: &str) -> PathBuf {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| {
        let folder = std::env::temp_dir().join(format!("biting-fuzz-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a scratch folder");
        folder
    });
    folder.join(name)
}

/// Writes `bytes` to the scratch file `name`.
pub fn put(name: &str, bytes: &[u8]) -> PathBuf {
    let path = path(name);
    std::fs::write(&path, bytes).expect("a scratch file");
    path
}
