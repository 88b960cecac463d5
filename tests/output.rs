//! What is written can be read back: VTI through vtkio, summary through its own reader.

use lahar::dem::Energies;
use lahar::fingerprint::Fingerprint;
use lahar::output::OutputError;
use lahar::output::isosurface::Mesh;
use lahar::output::vti::Image;
use lahar::run::summary::{
    CoupledPart, CouplingPart, DryPart, Extrema, FluidPart, GrainFingerprint, GrainPart, Parts,
};
use lahar::run::{Ended, Summary};
use vtkio::model::{Attribute, DataSet, IOBuffer, Piece};

const EXTENTS: [usize; 3] = [3, 4, 2];

fn folder(name: &str) -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// Values with all bits in use, so that a lost digit shows. vtkio looks for tags and entities in
/// raw data too (a fault of that reader), so values with a byte `<` or `&` are left out.
fn noise(n: usize) -> Vec<f64> {
    let all = (0..).map(|k| f64::from(k) - 20.0).map(|k| libm::sin(k) * libm::exp(0.1 * k));
    all.filter(|x| !x.to_le_bytes().iter().any(|b| b"<&".contains(b))).take(n).collect()
}

#[test]
fn exact_vti_read_back_by_vtkio() {
    let n = EXTENTS.iter().product();
    let density = noise(n);
    let velocity: Vec<[f64; 3]> = noise(3 * n).chunks(3).map(|c| [c[0], c[1], c[2]]).collect();
    let stress: Vec<[f64; 6]> =
        noise(6 * n).chunks(6).map(|c| [c[0], c[1], c[2], c[3], c[4], c[5]]).collect();
    let solid: Vec<u8> = (0..n).map(|k| (k % 3) as u8).collect();
    let path = folder("fields.vti");
    let image = Image::new(EXTENTS, [0.5, -1.0, 0.25], 0.125)
        .scalar("density", &density)
        .vector("velocity_m_per_s", &velocity)
        .tensor("stress_pa", &stress)
        .mask("solid & wall", &solid);
    image.write(&path).unwrap();

    let vtk = vtkio::Vtk::import(&path).unwrap();
    let DataSet::ImageData { origin, spacing, pieces, .. } = vtk.data else { panic!("not ImageData") };
    assert_eq!((origin, spacing), ([0.5, -1.0, 0.25], [0.125; 3]));
    let Piece::Inline(piece) = &pieces[0] else { panic!("no inline piece") };
    let array = |name: &str| {
        let found = piece.data.cell.iter().find_map(|a| match a {
            Attribute::DataArray(d) if d.name == name => Some(d.data.clone()),
            _ => None,
        });
        found.unwrap_or_else(|| panic!("no array {name}"))
    };
    let bits = |buffer: IOBuffer| -> Vec<u64> {
        let IOBuffer::F64(v) = buffer else { panic!("not f64") };
        v.iter().map(|x| x.to_bits()).collect()
    };
    let wanted = |v: Vec<f64>| -> Vec<u64> { v.iter().map(|x| x.to_bits()).collect() };
    assert_eq!(bits(array("density")), wanted(density));
    assert_eq!(bits(array("velocity_m_per_s")), wanted(velocity.concat()));
    // VTK's order of a symmetric tensor is xx yy zz xy yz xz.
    let reordered = stress.iter().flat_map(|t| [t[0], t[1], t[2], t[3], t[5], t[4]]).collect();
    assert_eq!(bits(array("stress_pa")), wanted(reordered));
    let IOBuffer::U8(mask) = array("solid & wall") else { panic!("not u8") };
    assert_eq!(mask, solid);
}

#[test]
fn vti_refuses_an_array_of_the_wrong_length() {
    let short = vec![0.0; 5];
    let error = Image::new(EXTENTS, [0.0; 3], 1.0).scalar("density", &short).to_bytes().unwrap_err();
    assert!(matches!(error, OutputError::Length { found: 5, expected: 24, .. }), "{error}");
}

#[test]
fn vti_states_its_time() {
    let bytes = Image::new(EXTENTS, [0.0; 3], 1.0).time(0.75).to_bytes().unwrap();
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains("Name=\"TimeValue\"") && text.contains(">0.75</DataArray>"), "{text}");
}

/// Lines with a value each, and points with numbers: as above, on numbers whose bytes vtkio can read.
#[test]
fn exact_lines_and_points_read_back_by_vtkio() {
    use lahar::output::vtp::{Cells, PolyData};
    let points = vec![[0.0, 0.5, 1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    let path = folder("lines.vtp");
    let lines = PolyData::new(&points, Cells::Lines(&[[0, 1], [2, 1]]), 0.5);
    lines.at_cells("normal_force_n", &[[2.0], [0.5]]).write(&path).unwrap();
    let piece = |path: &std::path::Path| {
        let DataSet::PolyData { pieces, .. } = vtkio::Vtk::import(path).unwrap().data else {
            panic!("not PolyData")
        };
        let Piece::Inline(piece) = pieces.into_iter().next().unwrap() else { panic!("no inline piece") };
        piece
    };
    let read = piece(&path);
    let Some(vtkio::model::VertexNumbers::XML { connectivity, offsets }) = &read.lines else {
        panic!("no lines")
    };
    assert_eq!((connectivity.as_slice(), offsets.as_slice()), (&[0, 1, 2, 1][..], &[2, 4][..]));
    assert!(matches!(read.data.cell.first(), Some(Attribute::DataArray(a)) if a.name == "normal_force_n"));
    let path = folder("points.vtp");
    let dots = PolyData::new(&points, Cells::Points, 0.5).count_at_points("number", [7, 8, 9].into_iter());
    dots.write(&path).unwrap();
    let read = piece(&path);
    let Some(vtkio::model::VertexNumbers::XML { connectivity, .. }) = &read.verts else {
        panic!("no points")
    };
    assert_eq!(connectivity.as_slice(), &[0, 1, 2]);
    let Some(Attribute::DataArray(array)) = read.data.point.first() else { panic!("no numbers") };
    assert!(matches!(&array.data, IOBuffer::I64(v) if v[..] == [7, 8, 9]), "{:?}", array.data);
    // An array of the wrong length is refused before anything is written.
    let path = folder("wrong.vtp");
    let wrong = PolyData::new(&points, Cells::Points, 0.5).at_points("radius_m", &[[1.0]]);
    assert!(wrong.write(&path).is_err() && !path.exists());
}

/// Positions of a mesh whose bytes are all far from `<` and `&` (see [`noise`]): whole numbers and halves.
#[test]
fn exact_vtp_read_back_by_vtkio() {
    let mesh = Mesh {
        points: vec![[0.0, 0.5, 1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]],
        vectors: vec![[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.5], [1.0, 1.0, 1.0]],
        triangles: vec![[0, 1, 2], [1, 3, 2]],
    };
    let path = folder("surface.vtp");
    lahar::output::vtp::write(&path, &mesh, "velocity_m_per_s", 0.25).unwrap();
    let vtk = vtkio::Vtk::import(&path).unwrap();
    let DataSet::PolyData { pieces, .. } = vtk.data else { panic!("not PolyData") };
    let Piece::Inline(piece) = &pieces[0] else { panic!("no inline piece") };
    let numbers = |buffer: &IOBuffer| -> Vec<f64> {
        let IOBuffer::F64(v) = buffer else { panic!("not f64") };
        v.clone()
    };
    assert_eq!(numbers(&piece.points), mesh.points.concat());
    let Some(Attribute::DataArray(array)) = piece.data.point.first() else { panic!("no point data") };
    assert_eq!(array.name, "velocity_m_per_s");
    assert_eq!(numbers(&array.data), mesh.vectors.concat());
    let Some(vtkio::model::VertexNumbers::XML { connectivity, offsets }) = &piece.polys else {
        panic!("no triangles")
    };
    assert_eq!(connectivity, &[0, 1, 2, 1, 3, 2]);
    assert_eq!(offsets, &[3, 6]);
}

/// What every summary says.
fn summary(ended: Ended, parts: Parts) -> Summary {
    let dry = matches!(parts, Parts::Dry(_));
    Summary {
        scene: "channel".to_owned(),
        scene_hash: lahar::run::summary::hash(b"{}"),
        version: "0.1.0".to_owned(),
        backend: (!dry).then(|| "plain".to_owned()),
        threads: 2,
        steps: 1000,
        time_s: 0.1 + 0.2,
        ended,
        wall_seconds: 1.5,
        million_updates_per_second: f64::INFINITY,
        parts,
        not_steady: None,
        rest: None,
        loads: Vec::new(),
        stopped: (ended == Ended::Stopped).then(|| "a guard".to_owned()),
    }
}

fn grain_part() -> GrainPart {
    GrainPart {
        number: 3,
        driven: 1,
        left: 2,
        left_kg: 0.1 + 0.2,
        mass_kg: 1.0,
        momentum_n_s: [0.1, -0.0, 1e-300],
        max_speed_m_per_s: f64::NAN,
        contacts: 4,
        energies_j: Energies { kinetic: 1.0 / 3.0, ..Energies::default() },
    }
}

fn fluid_part(grains: Option<CoupledPart>) -> FluidPart {
    FluidPart {
        mass_residual: -1.0e-17,
        density: Extrema::of([1.0, 1.0 + f64::EPSILON].into_iter()),
        speed_m_per_s: Extrema { least: 0.0, greatest: 0.3 },
        fingerprint: Fingerprint {
            step: 1000,
            hash: "0123456789abcdef".to_owned(),
            mass_excess: 0.0,
            momentum: [0.0; 3],
            max_speed: 0.1,
        },
        free_surface: None,
        grains,
    }
}

fn coupled_part() -> CoupledPart {
    let coupling = CouplingPart {
        sub_steps: 7,
        covered_cells: 10,
        cells_covered: 20,
        cells_freed: 5,
        mass_from_grains_kg: 1e-9,
        mass_over_links_kg: 2e-9,
        mass_covered_kg: -1e-9,
        mass_freed_kg: 0.0,
        from_grains_n_s: [0.1; 3],
        over_links_n_s: [0.2; 3],
        covered_n_s: [0.3; 3],
        freed_n_s: [0.4; 3],
        gradient_pa_per_m: [0.0, 0.0, 9810.0],
    };
    let fingerprint = "fedcba9876543210".to_owned();
    CoupledPart { grains: grain_part(), coupling, unexplained_j: 1e-12, fingerprint }
}

/// A fluid, grains in a fluid, grains alone: the file says the same when it is read back, and where.
#[test]
fn exact_summary_round_trip() {
    let dry = DryPart {
        grains: grain_part(),
        energy_residual: 1e-9,
        lists: 12,
        fingerprint: GrainFingerprint { step: 1000, hash: "aa".to_owned(), kinetic_energy_j: 0.25 },
    };
    for (ended, parts, number) in [
        (Ended::Steady, Parts::Fluid(Box::new(fluid_part(None))), None),
        (Ended::Stopped, Parts::Fluid(Box::new(fluid_part(Some(coupled_part())))), Some("/grains/grains")),
        (Ended::Empty, Parts::Dry(Box::new(dry)), Some("/grains")),
    ] {
        let summary = summary(ended, parts);
        let path = folder("summary.json");
        summary.write(&path).unwrap();
        // NaN is unlike itself.
        assert_eq!(format!("{:?}", Summary::read(&path).unwrap()), format!("{summary:?}"));
        let json: serde_json::Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
        assert_eq!(json["ended"].as_str().map(|word| word.replace('_', " ")).as_deref(), Some(word(ended)));
        let found = number.map(|at| json.pointer(at).and_then(serde_json::Value::as_u64));
        assert_eq!(found, number.map(|_| Some(3)), "{json}");
    }
}

fn word(ended: Ended) -> &'static str {
    match ended {
        Ended::Empty => "empty",
        other => other.words(),
    }
}
