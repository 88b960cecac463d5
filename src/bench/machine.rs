//! What this machine is.

use serde::Serialize;

/// Name and size.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Machine {
    /// Processor, as the system names it; the architecture where it does not.
    pub processor: String,
    /// Hardware threads this process may use.
    pub cores: usize,
    /// Last-level cache of the first core, bytes, where the system says.
    pub last_cache_bytes: Option<u64>,
    /// Memory that could be taken when the measurement began, bytes, where the system says.
    pub available_bytes: Option<u64>,
}

impl Machine {
    /// This one.
    #[must_use]
    pub(crate) fn this() -> Self {
        let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        Self {
            processor: processor(&text).unwrap_or_else(|| std::env::consts::ARCH.to_owned()),
            cores: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            last_cache_bytes: (0..=4).rev().find_map(cache),
            available_bytes: crate::plan::available_memory(),
        }
    }
}

/// Memory that the cases of a group may take, however much earlier groups took.
#[derive(Clone, Copy, Debug)]
pub(super) struct Memory {
    /// Pages this process held before the first group, bytes.
    resident: Option<u64>,
}

impl Memory {
    /// Before the first group.
    pub(super) fn now() -> Self {
        Self { resident: resident() }
    }

    /// Bytes that can still be taken; `None` where the system does not say.
    ///
    /// Blocks are too small to be mapped one by one: what a group gave up may stay with the allocator, which
    /// can return only what lies above the last page in use, and a note written down between two runs is
    /// enough to hold all below it. The system does not count it as available, but the next group gets it.
    pub(super) fn free(self) -> Option<u64> {
        let kept = resident().zip(self.resident).map_or(0, |(now, before)| now.saturating_sub(before));
        Some(crate::plan::available_memory()?.saturating_add(kept))
    }
}

/// Resident pages of this process, bytes.
fn resident() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kib.checked_mul(1024)
}

fn processor(cpuinfo: &str) -> Option<String> {
    let line = cpuinfo.lines().find_map(|line| line.strip_prefix("model name"))?;
    Some(line.trim_start().strip_prefix(':')?.trim().to_owned())
}

fn cache(index: u32) -> Option<u64> {
    let path = format!("/sys/devices/system/cpu/cpu0/cache/index{index}/size");
    size(std::fs::read_to_string(path).ok()?.trim())
}

/// A size such as `32768K`.
fn size(text: &str) -> Option<u64> {
    let unit = text.chars().last()?;
    let factor = match unit {
        'K' => 1 << 10,
        'M' => 1 << 20,
        'G' => 1 << 30,
        _ => return text.parse().ok(),
    };
    text.strip_suffix(unit)?.parse::<u64>().ok()?.checked_mul(factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_names_and_sizes_are_read() {
        let text = "processor\t: 0\nmodel name\t: Some CPU @ 2 GHz\nflags\t: fpu\n";
        assert_eq!(processor(text).as_deref(), Some("Some CPU @ 2 GHz"));
        assert_eq!(processor("processor\t: 0\n"), None);
        assert_eq!(size("32768K"), Some(32 << 20));
        assert_eq!(size("64"), Some(64));
        assert_eq!(size("K"), None);
    }
}
