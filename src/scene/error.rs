//! What can be wrong with a scene file.

pub use super::hint::Hint;
pub use super::key_rule::KeyRule;
pub use super::located::Located;
use super::words::{
    already, choose, did_you_mean, found_keys, list, list_or, list_static, not_whole, number, range,
    rename_or_add, rename_or_define, rename_or_remove, right_type, with_space,
};

/// A problem found while reading or checking a scene.
pub type SceneError = Located<SceneProblem>;

/// What is wrong. Every message says what was found, what is allowed and why, and a way out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the message above each variant says what its fields are")]
pub enum SceneProblem {
    /// The file could not be read.
    #[error("cannot be read: {kind}\n  way out: check the name and that it is a readable text file")]
    Unreadable { kind: std::io::ErrorKind },
    /// No regular file.
    #[error(
        "is a {kind}\n  \
         allowed: regular files; a scene is read as a whole, and its folder is where meshes and tables are looked for\n  \
         way out: write the scene into a file first"
    )]
    NotAFile { kind: &'static str },
    /// Text in another encoding.
    #[error(
        "{found}, line {line}\n  allowed: UTF-8, with or without a byte-order mark\n  \
         way out: save it as UTF-8"
    )]
    Encoding { found: &'static str, line: usize },
    /// Not JSON.
    #[error(
        "line {line}, column {column}: not JSON: {detail}\n  \
         way out: {way_out}"
    )]
    Syntax { line: usize, column: usize, detail: String, way_out: &'static str },
    /// NaN or Infinity.
    #[error(
        "line {line}, column {column}: found {token}\n  \
         allowed: finite decimal numbers; JSON has no {token}\n  \
         way out: write a number, or leave out an optional key"
    )]
    NotANumber { line: usize, column: usize, token: &'static str },
    /// Beyond f64.
    #[error(
        "line {line}, column {column}: a number beyond the range of 64-bit floating point\n  \
         allowed: magnitudes up to 1.7e308\n  \
         way out: check the exponent"
    )]
    NumberTooLarge { line: usize, column: usize },
    /// Unknown key.
    #[error(
        "unknown key `{key}`{}\n  \
         allowed here: {}\n  \
         way out: {}", did_you_mean(.hint.name.as_ref()), list(.allowed), rename_or_remove(.hint))]
    UnknownKey { key: String, hint: Hint, allowed: Vec<String> },
    /// Unknown choice.
    #[error(
        "unknown choice `{found}`{}\n  \
         allowed here: {}\n  \
         way out: {}", did_you_mean(.hint.name.as_ref()), list(.allowed), choose(.hint, .allowed))]
    UnknownChoice { found: String, hint: Hint, allowed: Vec<String> },
    /// Missing key.
    #[error(
        "key `{key}` is missing\n  allowed: scenes that have it; there is no default\n  \
         way out: add `\"{key}\": …` here"
    )]
    MissingKey { key: String },
    /// Key given twice.
    #[error(
        "key `{key}` is given twice\n  allowed: each key once\n  \
         way out: remove one of the two"
    )]
    DuplicateKey { key: String },
    /// Wrong JSON type.
    #[error(
        "found {found}\n  allowed: {expected}\n  \
         way out: {}", right_type(.found))]
    WrongType { found: String, expected: String },
    /// A quantity that must be > 0.
    #[error(
        "found {}{}\n  allowed: > 0, {because}\n  \
         way out: {way_out}", number(*.found), with_space(.unit))]
    NotPositive { found: f64, unit: &'static str, because: &'static str, way_out: &'static str },
    /// A quantity that must be ≥ 0.
    #[error(
        "found {}{}\n  allowed: ≥ 0, {because}\n  \
         way out: {way_out}", number(*.found), with_space(.unit))]
    Negative { found: f64, unit: &'static str, because: &'static str, way_out: &'static str },
    /// A quantity with a range.
    #[error(
        "found {found}{}\n  allowed: {}, {because}\n  \
         way out: {way_out}", with_space(.unit), range(*.low, *.high))]
    OutOfRange {
        found: f64,
        unit: &'static str,
        low: f64,
        high: f64,
        because: &'static str,
        way_out: &'static str,
    },
    /// Edge length is no multiple of the spacing.
    #[error(
        "found {} m, which is {} cells of {} m\n  \
         allowed: whole cells; walls lie on cell faces [B1]\n  \
         way out: the nearest edge length is {} m",
        number(*.size), not_whole(*.cells), number(*.spacing), number(*.nearest)
    )]
    NotMultiple { size: f64, spacing: f64, cells: f64, nearest: f64 },
    /// An edge shorter than a cell.
    #[error(
        "found {} m, less than one cell of {} m\n  allowed: at least one whole cell\n  \
         way out: an edge of {} m, or a smaller `domain.spacing_m`",
        number(*.size), number(*.spacing), number(*.spacing)
    )]
    NoCell { size: f64, spacing: f64 },
    /// More cells than can be indexed.
    #[error(
        "found {cells:.3e} cells\n  allowed: at most {max}, the largest cell index\n  \
         way out: a coarser `domain.spacing_m`, or one cell along periodic axes on which nothing changes"
    )]
    TooManyCells { cells: f64, max: u64 },
    /// One face periodic, the other not.
    #[error(
        "axis {axis}: `{periodic}` is periodic and `{other}` is not\n  \
         allowed: both or neither; what leaves through one face enters at the other\n  \
         way out: name a wall or a mirror plane for `{periodic}`"
    )]
    HalfPeriodic { axis: char, periodic: &'static str, other: &'static str },
    /// A moving wall that pushes fluid.
    #[error(
        "found {found} m/s normal to the face\n  \
         allowed: 0; a wall that stays in place can only slide in its plane [B1]\n  \
         way out: set component {axis} to 0"
    )]
    WallNormalVelocity { found: f64, axis: char },
    /// A table of motion whose times go back.
    #[error(
        "found {found} s after {before} s\n  allowed: times that ascend, one factor at a time\n  \
         way out: put the pairs in order, and keep one of each time"
    )]
    TimesNotAscending { before: f64, found: f64 },
    /// A vector whose length cannot be had.
    #[error(
        "found {found:?}\n  \
         allowed: components whose squares are numbers, up to 1e150 and not all below 1e-150; only the direction counts\n  \
         way out: divide them by the largest"
    )]
    EndlessVector { found: Vec<f64> },
    /// A direction of length zero.
    #[error(
        "found [0, 0, 0]\n  allowed: any vector but this one; it has no direction\n  \
         way out: {way_out}"
    )]
    ZeroVector { way_out: &'static str },
    /// Exactly one of several keys is wanted.
    #[error(
        "found {}\n  \
         allowed: {rule} of {}: {because}\n  \
         way out: {}", found_keys(.found), list_static(.of), .rule.way_out(.found))]
    KeyCount { found: Vec<&'static str>, of: &'static [&'static str], rule: KeyRule, because: &'static str },
    /// A key that has no effect here.
    #[error(
        "`{key}` has no effect here: {because}\n  \
         allowed: only keys that do something\n  \
         way out: remove it"
    )]
    UnusedKey { key: &'static str, because: &'static str },
    /// Corners in the wrong order.
    #[error(
        "axis {axis}: found from {} m to {} m\n  \
         allowed: the first less than the second, else nothing is inside\n  \
         way out: swap them, or make them different", number(*.low), number(*.high))]
    EmptyInterval { axis: char, low: f64, high: f64 },
    /// Too few corners or no area.
    #[error(
        "found {corners} corners enclosing {area} m²\n  \
         allowed: at least 3 corners around a positive area\n  \
         way out: add corners that are not on one line"
    )]
    FlatPolygon { corners: usize, area: f64 },
    /// Edges that cross.
    #[error(
        "the edge from corner {} to the next and the one from corner {} to the next meet at ({}, {}) m\n  \
         allowed: edges that meet at the corner between neighbours only; elsewhere inside and outside are not what is meant\n  \
         way out: put the corners in order around the area, or make two polygons",
        .corners[0], .corners[1], .at[0], .at[1]
    )]
    EdgesCross { corners: [usize; 2], at: [f64; 2] },
    /// Heights that mark missing data.
    #[error(
        "row {row}, column {column}: found {height} m, and {count} heights like it: a mark of missing data\n  \
         allowed: heights of the ground, less than 1e10 m in magnitude\n  \
         way out: fill the holes from the heights around them before they are put into the scene"
    )]
    NoData { row: usize, column: usize, height: f64, count: usize },
    /// A combination of no shapes.
    #[error("found no shape\n  allowed: at least one\n  way out: add a shape, or remove the combination")]
    NoPart,
    /// Rows of different lengths.
    #[error(
        "found {rows} rows, the first of {first} heights and another of {other}\n  \
         allowed: at least one row, all of the same length of at least 1\n  \
         way out: complete the rows"
    )]
    UnevenRows { rows: usize, first: usize, other: usize },
    /// An initial fluid without any shape.
    #[error(
        "found neither `fill_level` nor `shapes`\n  \
         allowed: at least one of them; together they are the fluid at time 0\n  \
         way out: add one, or leave out `initial` for fluid everywhere"
    )]
    EmptyInitial,
    /// A level without a direction.
    #[error(
        "the level has no axis, and there is no gravity to give one\n  \
         allowed: levels with an axis\n  \
         way out: add `\"axis\": \"z\"`, or gravity"
    )]
    LevelWithoutAxis,
    /// Only with a free surface.
    #[error(
        "{what} needs a free surface, but fluid fills the whole box\n  \
         allowed: only with `fluid.initial`\n  \
         way out: say with `fluid.initial` where the fluid is at time 0, or {otherwise}"
    )]
    NeedsSurface { what: &'static str, otherwise: &'static str },
    /// Not with a free surface.
    #[error(
        "{what} cannot be had together with a free surface\n  \
         allowed: {allowed}\n  \
         way out: leave it out, or leave out `fluid.initial`"
    )]
    NotWithSurface { what: &'static str, allowed: &'static str },
    /// A section along the normal of the bed.
    #[error(
        "found {axis}, the axis normal to the bed\n  \
         allowed: one of the two others; depth is measured along the normal\n  \
         way out: the axis along which the fluid flows"
    )]
    AcrossBed { axis: char },
    /// A name of no solid.
    #[error(
        "no solid is named `{name}`{}\n  \
         allowed: {}\n  \
         way out: {}",
        did_you_mean(.nearest.as_ref()),
        list_or(.solids, "names of `solids`; there is none"),
        rename_or_add(.nearest.as_ref()))]
    UnknownSolid { name: String, nearest: Option<String>, solids: Vec<String> },
    /// Only with fluid.
    #[error(
        "this measure needs a fluid around the grains\n  \
         allowed: only in scenes with `fluid`\n  \
         way out: remove the probe"
    )]
    NeedsFluid,
    /// Only with grains.
    #[error(
        "this measure needs grains\n  allowed: only in scenes with `grains`\n  way out: remove the probe"
    )]
    NeedsGrains,
    /// Not together with grains in the fluid.
    #[error(
        "{what} cannot be had together with grains\n  \
         allowed: {allowed}\n  \
         way out: leave one of them out"
    )]
    NotWithGrains { what: &'static str, allowed: &'static str },
    /// A name of nothing.
    #[error(
        "no {kind} is named `{name}`{}\n  \
         allowed: {}\n  \
         way out: {}",
        did_you_mean(.nearest.as_ref()),
        list_or(.names, &format!("names of a {kind}; there is none")),
        rename_or_define(.nearest.as_ref(), .kind))]
    UnknownName { kind: &'static str, name: String, nearest: Option<String>, names: Vec<String> },
    /// A list without entries.
    #[error("found an empty list\n  allowed: at least one entry\n  way out: add {what}")]
    EmptyList { what: &'static str },
    /// A shape that this cannot be done with.
    #[error(
        "this shape cannot be {what}\n  \
         allowed: {allowed}\n  \
         way out: {way_out}"
    )]
    ShapeNotForGrains { what: &'static str, allowed: &'static str, way_out: &'static str },
    /// A rotation by nothing.
    #[error(
        "found [0, 0, 0, 0]\n  \
         allowed: any quaternion (w, x, y, z) but this one; it turns nowhere\n  \
         way out: [1, 0, 0, 0] for the clump as drawn"
    )]
    ZeroQuaternion,
    /// A sieve curve that does not rise from 0 to 1.
    #[error(
        "this is no sieve curve\n  \
         allowed: at least two [diameter in m, share of the mass that passes], diameters above 0 and rising, shares \
         rising from 0 to 1\n  \
         way out: add the diameter that nothing passes at the start, and the one that all passes at the end"
    )]
    BadSieveCurve,
    /// Outside the box.
    #[error(
        "axis {axis}: found {} m to {} m\n  \
         allowed: something between 0 m and {} m, the box\n  \
         way out: move it into the box, or remove it", number(*.low), number(*.high), number(*.size))]
    OutsideDomain { axis: char, low: f64, high: f64, size: f64 },
    /// A name used twice.
    #[error("name `{name}` is used twice\n  allowed: unique names\n  way out: rename one")]
    DuplicateName { name: String },
    /// A name that cannot be a file name or column.
    #[error(
        "found name `{name}`\n  \
         allowed: letters, digits, `_` and `-`, at least one; it becomes a column or a file name\n  \
         way out: rename it"
    )]
    BadName { name: String },
    /// A name that makes a file name too long.
    #[error(
        "found a name of {length} letters\n  \
         allowed: at most {limit}; it becomes part of file names, which systems limit to 255 letters\n  \
         way out: shorten it"
    )]
    LongName { length: usize, limit: usize },
    /// Two columns or files of one name.
    #[error(
        "`{by}` makes {what} `{name}`, {}\n  \
         allowed: names that differ, whatever their capital letters\n  \
         way out: rename one", already(.other.as_ref()))]
    NamesCollide { what: &'static str, name: String, by: String, other: Option<String> },
    /// A wave across a wall.
    #[error(
        "axis {axis}: found {count} periods between walls\n  \
         allowed: 0 along an axis that is not periodic; the wave would not match the wall\n  \
         way out: make axis {axis} periodic, or set its wave count to 0"
    )]
    WaveAcrossWall { axis: char, count: i64 },
    /// A wave without a wave vector.
    #[error(
        "found wave counts that are all 0\n  \
         allowed: at least one period in the box\n  \
         way out: set one of them to 1, or use `uniform`"
    )]
    NoWave,
    /// Longitudinal wave.
    #[error(
        "amplitude · wave vector = {found} (relative)\n  \
         allowed: 0; the flow must have no divergence\n  \
         way out: choose an amplitude normal to the wave vector"
    )]
    NotTransverse { found: f64 },
    /// Different wave lengths.
    #[error(
        "found wave lengths {}, {} and {} m\n  \
         allowed: three equal ones; only then does the starting pressure balance this flow\n  \
         way out: choose wave counts in proportion to `domain.size_m`", .lengths[0], .lengths[1], .lengths[2])]
    UnequalWaves { lengths: [f64; 3] },
    /// Limits in the wrong order.
    #[error(
        "found {low} to {high}{}\n  \
         allowed: the least below the largest\n  \
         way out: swap them", with_space(.unit))]
    LimitsSwapped { low: f64, high: f64, unit: &'static str },
    /// More entries than a byte can number.
    #[error(
        "found {found} entries\n  \
         allowed: at most {max}; cells store the number in one byte\n  \
         way out: join shapes"
    )]
    TooMany { found: usize, max: usize },
    /// Single precision with what only the plain backend has.
    #[error(
        "single precision is only in the fast backend, and {what} is only in the plain one\n  \
         allowed: `double` together with it\n  \
         way out: leave one of the two out"
    )]
    OnlyDouble { what: &'static str },
    /// A field that files do not have.
    #[error(
        "files of this scene have no such field\n  \
         allowed: `fill`, `kind` and `yielded` with a free surface, `covered` with grains, `solid` with solids, `fluid` with \
         layers, and the others in any scene\n  \
         way out: remove it from the list"
    )]
    NoSuchField,
    /// A time beyond the end.
    #[error(
        "found {} s\n  \
         allowed: at most the end time, {} s\n  \
         way out: a shorter interval, or a later `stop.end_time_s`", number(*.found), number(*.end))]
    BeyondEnd { found: f64, end: f64 },
}
