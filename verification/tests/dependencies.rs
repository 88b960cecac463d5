//! What lahar is built from: licences that go with its own, and packages from the registry only. `deny.toml` says the same to
//! cargo-deny, which also knows advisories.

use std::process::Command;

/// Licences that allow use under MIT or Apache-2.0.
const ALLOWED: [&str; 11] = [
    "MIT",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// Whether an SPDX expression can be met with allowed licences. `/` is how old packages write OR.
fn is_allowed(expression: &str) -> bool {
    let expression = expression.replace(['(', ')'], " ").replace('/', " OR ");
    // OR binds less than AND; brackets occur around an OR within an AND, of which then every part must be allowed.
    let one = |licence: &str| ALLOWED.contains(&licence.trim());
    let all = |part: &str| part.split(" AND ").all(one);
    expression.split(" OR ").any(all)
        && (!expression.contains(" AND ") || expression.split(" AND ").all(|p| p.split(" OR ").any(one)))
}

#[test]
fn limit_licences() {
    for good in [
        "MIT",
        "MIT/Apache-2.0",
        "GPL-3.0 OR MIT",
        "(MIT OR Apache-2.0) AND Unicode-3.0",
        "Apache-2.0 WITH LLVM-exception OR MIT",
    ] {
        assert!(is_allowed(good), "{good}");
    }
    for bad in ["GPL-3.0", "MIT AND GPL-3.0", "(MIT OR Apache-2.0) AND GPL-2.0", "", "LGPL-2.1 OR MPL-2.0"] {
        assert!(!is_allowed(bad), "{bad}");
    }
}

#[test]
fn licences_and_sources_of_all_packages_are_allowed() {
    let root = lahar_verification::golden::package_root();
    // What is built here: packages of other platforms need not be on this machine.
    let host = Command::new("rustc").arg("-vV").output().expect("rustc starts").stdout;
    let host = String::from_utf8(host).expect("UTF-8");
    let host = host.lines().find_map(|line| line.strip_prefix("host: ")).expect("a host");
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--offline", "--locked", "--filter-platform", host])
        .current_dir(&root)
        .output()
        .expect("cargo starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let built: Vec<&serde_json::Value> =
        metadata["resolve"]["nodes"].as_array().expect("nodes").iter().map(|node| &node["id"]).collect();
    let packages = metadata["packages"].as_array().expect("packages");
    let packages: Vec<_> = packages.iter().filter(|package| built.contains(&&package["id"])).collect();
    assert!(packages.len() > 50, "{} packages", packages.len());
    let fault = |package: &&&serde_json::Value| {
        let source = package["source"].as_str();
        let licence = package["license"].as_str().unwrap_or_default();
        !is_allowed(licence) || source.is_some_and(|source| !source.starts_with("registry+"))
    };
    let faults: Vec<String> = packages
        .iter()
        .filter(fault)
        .map(|p| format!("{} {}: licence {}, source {}", p["name"], p["version"], p["license"], p["source"]))
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
