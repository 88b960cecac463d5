//! What words of other programs, papers and habits mean in a scene.

use super::nearest::nearest;

/// Words with one meaning, and the names that may stand for it here, the likeliest first.
struct Meaning {
    words: &'static [&'static str],
    names: &'static [&'static str],
    /// What else has to be said: another unit, or that there is no such thing.
    note: &'static str,
}

const fn meaning(
    words: &'static [&'static str],
    names: &'static [&'static str],
    note: &'static str,
) -> Meaning {
    Meaning { words, names, note }
}

const NO_INFLOW: &str = "there is no inflow: draw a reservoir in `fluid.initial` that runs out, or drive the fluid along a \
                         periodic axis with gravity or `fluid.body_force`";
const NO_MESH: &str = "meshes are walls of grains without fluid; with fluid give a `shape`: `heightfield` for terrain, \
                       `polygon`, or a `union` of shapes";
const HALF: &str = "half of the diameter";
const TIMES_DENSITY: &str = "the kinematic viscosity times the density";

/// Without units: `height` stands for `height_m` too.
const MEANINGS: &[Meaning] = &[
    // The box and its faces.
    meaning(
        &["dx", "dh", "h", "delta_x", "cell_size", "grid_size", "grid_spacing", "resolution", "voxel_size"],
        &["spacing_m"],
        "",
    ),
    meaning(&["length", "extent", "extents", "lx", "box_size", "dimensions", "shape"], &["size_m"], ""),
    meaning(&["grid", "geometry", "box", "mesh", "computational_domain"], &["domain"], ""),
    meaning(&["boundary_conditions", "bc", "bcs", "boundary", "faces"], &["boundaries"], ""),
    meaning(
        &["wall", "walls", "noslip", "bounce_back", "bounceback", "solid_wall", "fixed_wall", "stick"],
        &["no_slip"],
        "",
    ),
    meaning(
        &["slip", "symmetry", "symmetric", "symmetry_plane", "mirror", "frictionless"],
        &["free_slip"],
        "",
    ),
    meaning(&["cyclic", "wrap", "wrapped"], &["periodic"], ""),
    meaning(&["lid", "moving", "sliding_wall", "velocity_wall"], &["moving_wall"], ""),
    meaning(
        &["outflow", "outlet", "pressure_outlet", "zero_gradient", "free_outflow", "atmosphere"],
        &["open"],
        "",
    ),
    meaning(&["inflow", "inlet", "velocity_inlet", "source", "hydrograph", "mass_inflow"], &[], NO_INFLOW),
    // Gravity.
    meaning(&["g", "acceleration", "gravity", "magnitude"], &["magnitude_m_per_s2", "gravity"], ""),
    meaning(
        &["slope", "angle", "inclination", "slope_angle", "tilt", "slope_degrees", "theta"],
        &["slope_deg"],
        "",
    ),
    // Fluid.
    meaning(&["rho", "rho0", "density", "mass_density"], &["density_kg_per_m3"], ""),
    meaning(
        &["mu", "eta", "viscosity", "dynamic_viscosity", "plastic_viscosity"],
        &["viscosity_pa_s", "plastic_viscosity_pa_s", "consistency_pa_s_n"],
        "",
    ),
    meaning(
        &["nu", "kinematic_viscosity", "viscosity_m2_per_s"],
        &["viscosity_pa_s", "plastic_viscosity_pa_s"],
        TIMES_DENSITY,
    ),
    meaning(
        &["tau_y", "tauy", "tau0", "tau_0", "tau_c", "sigma0", "yield", "cohesion"],
        &["yield_stress_pa"],
        "",
    ),
    meaning(&["k", "consistency", "consistency_index"], &["consistency_pa_s_n"], ""),
    meaning(
        &[
            "n",
            "index",
            "exponent",
            "power",
            "power_law_index",
            "power_index",
            "flow_behavior_index",
            "behaviour_index",
        ],
        &["flow_index"],
        "",
    ),
    meaning(&["m", "regularisation", "regularization", "regularization_parameter"], &["growth_s"], ""),
    meaning(&["law", "model", "viscosity_model", "material", "rheology_model"], &["rheology"], ""),
    meaning(&["newton", "water", "constant_viscosity"], &["newtonian"], ""),
    meaning(&["hb", "herschel", "herschelbulkley"], &["herschel_bulkley"], ""),
    meaning(&["ostwald", "power", "powerlaw", "glen"], &["power_law"], ""),
    meaning(&["plastic", "bingham_plastic", "viscoplastic"], &["bingham"], ""),
    meaning(&["force", "forcing", "pressure_gradient", "external_force"], &["body_force"], ""),
    meaning(
        &["level", "water_level", "fill_height", "depth", "height", "surface_level"],
        &["fill_level", "height_m"],
        "",
    ),
    meaning(&["reservoir", "start", "initial_condition", "initial_conditions", "ic"], &["initial"], ""),
    meaning(&["fluids", "phases", "strata"], &["layers"], ""),
    // Solids and shapes.
    meaning(
        &[
            "obstacle",
            "obstacles",
            "bodies",
            "structures",
            "walls",
            "objects",
            "barriers",
            "terrain",
            "topography",
        ],
        &["solids"],
        "",
    ),
    meaning(&["mesh", "stl", "obj", "surface_mesh", "file"], &["mesh"], NO_MESH),
    meaning(&["cuboid", "cube", "block", "rectangle", "brick", "aabb"], &["box"], ""),
    meaning(&["ball", "circle"], &["sphere"], ""),
    meaning(&["pipe", "tube", "disc", "disk", "column"], &["cylinder"], ""),
    meaning(&["plane", "halfspace", "floor", "ramp"], &["half_space"], ""),
    meaning(&["prism", "extrusion", "extruded_polygon", "wedge", "triangle"], &["polygon"], ""),
    meaning(
        &[
            "raster",
            "terrain",
            "dem",
            "height_map",
            "heightmap",
            "elevation",
            "topography",
            "bathymetry",
            "esri_ascii",
        ],
        &["heightfield"],
        "",
    ),
    meaning(&["diameter", "d"], &["radius_m"], HALF),
    meaning(&["base_diameter", "bottom_diameter"], &["base_radius_m"], HALF),
    meaning(&["top_diameter"], &["top_radius_m"], HALF),
    meaning(&["radius", "r"], &["radius_m", "base_radius_m"], ""),
    meaning(
        &["center", "centre", "position", "origin", "location"],
        &["centre_m", "position_m", "point_m"],
        "",
    ),
    meaning(&["vertices", "corners", "points", "coordinates"], &["points_m"], ""),
    meaning(&["elevations", "z", "values", "data"], &["heights_m"], ""),
    meaning(&["omega", "angular_velocity", "rotation_speed", "rpm"], &["spin_rad_per_s"], ""),
    // Numerics.
    meaning(&["dt", "delta_t", "timestep", "step"], &["time_step_s"], ""),
    meaning(&["tau", "relaxation"], &["relaxation_time"], ""),
    meaning(&["ma", "mach", "mach_number"], &["target_mach"], ""),
    meaning(&["u_max", "umax", "characteristic_velocity", "u_ref"], &["reference_velocity_m_per_s"], ""),
    meaning(&["scheme", "collision_operator", "collision_model"], &["operator", "collision"], ""),
    meaning(&["mrt", "cumulant", "cascaded", "clbm", "raw_mrt"], &["central_moment"], ""),
    meaning(&["srt", "lbgk", "single_relaxation_time"], &["bgk"], ""),
    meaning(&["float", "f32", "fp32", "float32"], &["single"], ""),
    meaning(&["f64", "fp64", "float64"], &["double"], ""),
    // End.
    meaning(
        &[
            "t_end",
            "tend",
            "tmax",
            "t_max",
            "max_time",
            "final_time",
            "total_time",
            "duration",
            "until",
            "simulation_time",
        ],
        &["end_time_s"],
        "",
    ),
    meaning(&["end", "time", "termination", "run"], &["stop"], ""),
    // Output.
    meaning(
        &["interval", "every", "write_interval", "output_interval", "dump_interval", "save_every", "period"],
        &["every_s"],
        "",
    ),
    meaning(&["frames", "number", "n_outputs", "number_of_outputs"], &["count"], ""),
    meaning(&["vtk", "vti", "snapshots", "paraview", "volume_output"], &["fields"], ""),
    meaning(&["timeseries", "time_series", "history", "log"], &["series"], ""),
    meaning(&["outputs", "results", "writing"], &["output"], ""),
    meaning(&["sensors", "gauges", "monitors", "measurements", "probe"], &["probes"], ""),
    meaning(
        &[
            "max_height",
            "max_depth",
            "height",
            "depth",
            "thickness",
            "flow_depth",
            "flow_height",
            "surface_height",
        ],
        &["surface_profile", "depth_map"],
        "it has bed, depth and surface at all times it is written",
    ),
    meaning(&["runout", "run_out", "front_position", "travel_distance"], &["front"], ""),
    meaning(&["discharge", "flux", "volume_flux", "q", "throughput"], &["flow_rate", "flux"], ""),
    meaning(&["max_velocity", "peak_velocity", "peak_speed"], &["max_speed"], ""),
    meaning(&["velocity", "point", "velocity_at"], &["point_velocity"], ""),
    meaning(&["impact", "impact_force", "load", "drag", "pressure"], &["force"], ""),
    meaning(&["moment", "couple"], &["torque"], ""),
    meaning(&["energy"], &["kinetic_energy", "energies"], ""),
    // Grains.
    meaning(&["particles", "spheres", "dem", "boulders", "granular"], &["grains"], ""),
    meaning(&["young", "youngs_modulus", "e", "stiffness", "elastic_modulus"], &["young_modulus_pa"], ""),
    meaning(&["poisson", "nu"], &["poisson_ratio"], ""),
    meaning(&["cor", "coefficient_of_restitution", "restitution_coefficient"], &["restitution"], ""),
    meaning(&["mu_s", "friction_coefficient", "coulomb_friction"], &["friction"], ""),
    meaning(&["seed_count", "number", "n_particles", "number_of_particles"], &["count"], ""),
    meaning(&["porosity", "packing_fraction", "volume_fraction"], &["solid_fraction"], ""),
];

/// Units that names end in.
const UNITS: &[&str] = &[
    "_kg_per_m3",
    "_m_per_s2",
    "_m_per_s",
    "_rad_per_s",
    "_n_per_m3",
    "_pa_s_n",
    "_pa_s",
    "_pa",
    "_deg",
    "_hz",
    "_mm",
    "_cm",
    "_m",
    "_s",
];

/// A word in lower case with underscores, without its unit.
fn bare(word: &str) -> String {
    let (mut plain, mut after_small) = (String::new(), false);
    for c in word.chars() {
        // `endTime`, but not `MRT`.
        if c.is_uppercase() && after_small {
            plain.push('_');
        }
        after_small = c.is_lowercase();
        plain.extend(if c == '-' || c == ' ' { '_' } else { c }.to_lowercase());
    }
    let unit = UNITS.iter().find(|unit| plain.len() > unit.len() && plain.ends_with(*unit));
    unit.map_or(plain.clone(), |unit| plain[..plain.len() - unit.len()].to_owned())
}

/// What to write instead of an unknown word.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Hint {
    /// The name that was probably meant.
    pub name: Option<String>,
    /// What else has to be said; may be empty.
    pub note: &'static str,
}

/// The allowed name that was probably meant: by what the word means elsewhere, or as it is written.
#[must_use]
pub(crate) fn hint(found: &str, allowed: &[String]) -> Hint {
    let meant = meant(found, allowed);
    let (name, note) = match meant {
        Some((Some(name), note)) => (Some(name), note),
        other => {
            let written = nearest(found, allowed);
            let note = other.filter(|_| written.is_none()).map_or("", |(_, note)| note);
            (written, note)
        }
    };
    Hint { name: name.map(str::to_owned), note }
}

/// The allowed name with the meaning of `found`, and what else has to be said; with no name if there is no such thing.
fn meant<'a>(found: &str, allowed: &'a [String]) -> Option<(Option<&'a str>, &'static str)> {
    let word = bare(found);
    let about: Vec<&Meaning> = MEANINGS.iter().filter(|m| m.words.contains(&word.as_str())).collect();
    let named = about.iter().find_map(|meaning| {
        let mut names = meaning.names.iter().filter_map(|name| allowed.iter().find(|other| other == name));
        names.next().map(|name| (Some(name.as_str()), meaning.note))
    });
    // A note may stand alone: what it is about is not to be had here.
    let alone = about.iter().find(|m| [NO_INFLOW, NO_MESH].contains(&m.note)).map(|m| (None, m.note));
    named.or(alone)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_other_programs() {
        let cases: &[(&str, &[&str], &str)] = &[
            ("max_height", &["point_velocity", "surface_profile", "mass"], "surface_profile"),
            ("base_diameter_m", &["base_m", "base_radius_m", "direction"], "base_radius_m"),
            ("dx", &["size_m", "spacing_m", "boundaries"], "spacing_m"),
            ("endTime", &["end_time_s", "steady"], "end_time_s"),
            ("t_end", &["end_time_s", "steady"], "end_time_s"),
            ("outlet", &["periodic", "no_slip", "open"], "open"),
            ("MRT", &["bgk", "trt", "central_moment"], "central_moment"),
            ("obstacles", &["domain", "solids", "fluid"], "solids"),
            ("bounce-back", &["no_slip", "free_slip"], "no_slip"),
        ];
        for (found, allowed, name) in cases {
            let allowed: Vec<String> = allowed.iter().map(|&name| name.to_owned()).collect();
            assert_eq!(hint(found, &allowed).name.as_deref(), Some(*name), "{found}");
        }
    }

    #[test]
    fn limit_what_does_not_exist_gets_a_note_and_no_name() {
        let allowed = ["periodic", "no_slip", "moving_wall", "open"].map(str::to_owned);
        assert_eq!(meant("inflow", &allowed), Some((None, NO_INFLOW)));
        assert_eq!(meant("mesh", &["name", "shape"].map(str::to_owned)), Some((None, NO_MESH)));
        assert_eq!(meant("temperature", &allowed), None);
    }
}
