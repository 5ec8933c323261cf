//! Hashes that stay the same from version to version: FNV-1a of 64 bits.

/// Of no bytes.
const START: u64 = 0xcbf2_9ce4_8422_2325;

/// The hash of a text.
pub fn fnv(text: &str) -> u64 {
    after(START, text.bytes())
}

/// The hash of more bytes after those of `before`.
pub fn after(before: u64, bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(before, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// The hash of another text after those that were digested so far, each in hexadecimal digits; nothing is digested at first.
pub fn digest(before: &str, text: &str) -> String {
    let before = u64::from_str_radix(before, 16).unwrap_or(START);
    format!("{:016x}", after(before, text.bytes().chain([b'/'])))
}
