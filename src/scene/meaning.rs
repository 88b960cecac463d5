//! What words of other programs, papers and habits mean in a scene.

/// Words with one meaning, and the names that may stand for it here, the likeliest first.
pub(super) struct Meaning {
    pub(super) words: &'static [&'static str],
    /// None where there is no such thing; the note says so.
    pub(super) names: &'static [&'static str],
    /// What else has to be said: another unit, or that there is no such thing.
    pub(super) note: &'static str,
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
pub(super) const NO_MESH: &str = "meshes are walls of grains without fluid; with fluid give a `shape`: `heightfield` for terrain, \
                       `polygon`, or a `union` of shapes";
const CELLS: &str = "the edge length over the number of cells along it";
const NO_PERIODIC_KEY: &str = "leave out both faces of an axis in `domain.boundaries` to make it periodic";
const NO_TENSION: &str =
    "there is no surface tension: lahar is for flows that are large against the capillary length";
const NO_HEAT: &str = "there is no heat: give the rheology at the temperature of the flow";
const NO_TURBULENCE: &str =
    "there is no turbulence model: the flow is resolved as it is, and `lahar plan` says its Reynolds number";
const NO_REFINEMENT: &str = "all cells have one size: `domain.spacing_m`";
const NO_UNITS: &str = "every key names its unit, and all of them are SI";
const NOT_IN_THE_SCENE: &str = "it is an option of the command: `lahar run --help`";
const NO_STEPS: &str = "a run ends at `stop.end_time_s`; `lahar plan` says how many steps that is";
const HALF: &str = "half of the diameter";
const TIMES_DENSITY: &str = "the kinematic viscosity times the density";

/// Without units: `height` stands for `height_m` too.
pub(super) const MEANINGS: &[Meaning] = &[
    // The box and its faces.
    meaning(
        &["dx", "dh", "h", "delta_x", "cell_size", "grid_size", "grid_spacing", "voxel_size"],
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
    meaning(&["periodic", "periodicity"], &[], NO_PERIODIC_KEY),
    meaning(&["cells", "nx", "ny", "nz", "n_cells", "resolution", "grid_cells"], &["spacing_m"], CELLS),
    meaning(&["refinement", "amr", "levels_of_refinement"], &[], NO_REFINEMENT),
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
    meaning(
        &["vector", "down", "gravity_vector"],
        &["direction"],
        "`magnitude_m_per_s2` is a key of its own",
    ),
    // Fluid.
    meaning(&["surface_tension", "sigma", "contact_angle", "wetting"], &[], NO_TENSION),
    meaning(&["temperature", "heat", "thermal"], &[], NO_HEAT),
    meaning(&["turbulence", "les", "smagorinsky", "turbulence_model"], &[], NO_TURBULENCE),
    meaning(&["start_velocity", "v0", "u0"], &["initial_velocity"], ""),
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
    meaning(&["omega", "angular_velocity", "rotation_speed"], &["spin_rad_per_s"], ""),
    meaning(&["rpm"], &["spin_rad_per_s"], "a vector, of numbers times 0.10472"),
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
    meaning(
        &["threads", "backend", "n_threads", "cores", "checkpoint", "quiet", "out_dir"],
        &[],
        NOT_IN_THE_SCENE,
    ),
    meaning(&["steps", "max_steps", "time_steps", "n_steps", "iterations", "nt"], &[], NO_STEPS),
    meaning(&["units", "unit", "unit_system"], &[], NO_UNITS),
    meaning(&["name", "label", "scene"], &["title"], ""),
    meaning(&["comment", "_comment", "comments", "note", "notes", "remark", "info"], &["description"], ""),
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
    meaning(&["young", "youngs_modulus", "stiffness", "elastic_modulus"], &["young_modulus_pa"], ""),
    meaning(&["poisson", "nu"], &["poisson_ratio"], ""),
    meaning(&["e"], &["restitution", "young_modulus_pa"], ""),
    meaning(&["cor", "coefficient_of_restitution", "restitution_coefficient"], &["restitution"], ""),
    meaning(&["hertz", "hertz_mindlin", "hertzian"], &["tsuji", "visco_elastic"], ""),
    meaning(&["spring_dashpot", "hooke", "lsd"], &["linear"], ""),
    meaning(&["mu_s", "friction_coefficient", "coulomb_friction"], &["friction"], ""),
    meaning(&["seed_count", "number", "n_particles", "number_of_particles"], &["count"], ""),
    meaning(&["porosity", "packing_fraction", "volume_fraction"], &["solid_fraction"], ""),
];
