//! Mutants of files that are no JSON, and of JSON as text.

use super::random::Random;

/// Words in place of a number: what readers have to refuse or bear.
const NUMBERS: &[&str] = &[
    "NaN",
    "nan",
    "inf",
    "-inf",
    "Infinity",
    "1e999",
    "-1e999",
    "1e-999",
    "0",
    "-0",
    "-1",
    "1",
    "4294967296",
    "1e300",
    "-1e300",
    "1e-300",
    "18446744073709551616",
    "-9999",
    "0x10",
    "1,5",
    "1.5.5",
    "+1",
    "",
    "٣",
    "1e",
    "--1",
];

/// Changes one place, rarely up to four: more of a small file is refused at its first line.
pub fn mutate(bytes: &mut Vec<u8>, donor: &[u8], random: &mut Random) {
    once(bytes, donor, random);
    for _ in 0..3 {
        if random.once_in(4) {
            once(bytes, donor, random);
        }
    }
}

fn once(bytes: &mut Vec<u8>, donor: &[u8], random: &mut Random) {
    let at = random.below(bytes.len());
    let length = 1 + random.below(16).min(bytes.len().saturating_sub(at + 1));
    let end = (at + length).min(bytes.len());
    match random.below(12) {
        0 if !bytes.is_empty() => bytes[at] ^= 1 << random.below(8),
        1 if !bytes.is_empty() => bytes[at] = random.next() as u8,
        2 => drop(bytes.drain(at..end)),
        3 => {
            let again = bytes[at..end].repeat(1 + random.below(40));
            bytes.splice(at..at, again);
        }
        4 => bytes.truncate(at),
        5 => {
            let from = random.below(donor.len());
            let to = donor.len().min(from + 1 + random.below(200));
            bytes.splice(at..end, donor[from..to].iter().copied());
        }
        6 => drop(bytes.splice(at..at, random.next().to_le_bytes())),
        _ => number(bytes, at, random),
    }
}

/// Puts another word in place of the number at or after a place.
fn number(bytes: &mut Vec<u8>, at: usize, random: &mut Random) {
    let part = |b: &u8| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+' | b'e' | b'E');
    let Some(start) = bytes[at..].iter().position(u8::is_ascii_digit).map(|k| at + k) else { return };
    let end = bytes[start..].iter().position(|b| !part(b)).map_or(bytes.len(), |k| start + k);
    // Every second time another number of as many digits, which may be accepted.
    if random.once_in(2) {
        bytes[end - 1] = if bytes[end - 1].is_ascii_digit() { b'0' + random.below(10) as u8 } else { b'1' };
        return;
    }
    let word = random.pick(NUMBERS).copied().unwrap_or_default();
    bytes.splice(start..end, word.bytes());
}
