//! How much memory this process may still take: what the machine has, and what it is allowed.

/// Memory that can still be taken, bytes: the least of what the machine has free, what the control groups leave, and what
/// the limit of the address space leaves; `None` where the system does not say.
#[must_use]
pub fn available() -> Option<u64> {
    [of_machine(), of_groups(), of_address_space()].into_iter().flatten().min()
}

fn of_machine() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    kib(&text, "MemAvailable:")
}

/// A line of a file below `/proc`, bytes.
fn kib(text: &str, key: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(key))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

/// The least that any group of this process leaves, from its own up to the root: version 2 and version 1.
fn of_groups() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/cgroup").ok()?;
    let mut least: Option<u64> = None;
    for line in text.lines() {
        let mut parts = line.splitn(3, ':').skip(1);
        let (Some(kinds), Some(path)) = (parts.next(), parts.next()) else { continue };
        let (root, names) = match kinds {
            "" => ("/sys/fs/cgroup", ["memory.max", "memory.current", "memory.stat"]),
            kinds if kinds.split(',').any(|kind| kind == "memory") => {
                ("/sys/fs/cgroup/memory", ["memory.limit_in_bytes", "memory.usage_in_bytes", "memory.stat"])
            }
            _ => continue,
        };
        // In a container the group's own folder is mounted at the root.
        for folder in std::path::Path::new(path).ancestors() {
            let folder = std::path::Path::new(root).join(folder.strip_prefix("/").unwrap_or(folder));
            let read = |name: &str| std::fs::read_to_string(folder.join(name)).ok();
            let [limit, used, stat] = names.map(read);
            if let Some(left) = left(limit.as_deref(), used.as_deref(), stat.as_deref()) {
                least = Some(least.map_or(left, |least| least.min(left)));
            }
        }
    }
    least
}

/// What a group leaves: its limit less what it holds and cannot give back; files in the cache can be given back.
fn left(limit: Option<&str>, used: Option<&str>, stat: Option<&str>) -> Option<u64> {
    let limit: u64 = limit?.trim().parse().ok()?;
    let used: u64 = used?.trim().parse().ok()?;
    let cached = stat.and_then(|text| {
        let line = text.lines().find_map(|line| line.strip_prefix("inactive_file "))?;
        line.trim().parse::<u64>().ok()
    });
    // Version 1 says "no limit" by a number of pages that no machine has.
    (limit < 1 << 60).then(|| limit.saturating_sub(used.saturating_sub(cached.unwrap_or(0))))
}

/// What the limit of the address space (`ulimit -v`) leaves.
#[cfg(unix)]
fn of_address_space() -> Option<u64> {
    let limit = rustix::process::getrlimit(rustix::process::Resource::As).current?;
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    Some(limit.saturating_sub(kib(&text, "VmSize:").unwrap_or(0)))
}

#[cfg(not(unix))]
fn of_address_space() -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_room_in_a_group() {
        assert_eq!(left(Some("1000\n"), Some("600\n"), Some("anon 1\ninactive_file 100\n")), Some(500));
        assert_eq!(left(Some("1000"), Some("1600"), None), Some(0));
        assert_eq!(left(Some("max\n"), Some("600"), None), None);
        assert_eq!(left(Some("9223372036854771712"), Some("600"), None), None, "no limit in version 1");
        assert_eq!(kib("MemTotal: 5 kB\nMemAvailable:   12 kB\n", "MemAvailable:"), Some(12 * 1024));
    }
}
