//! exp, exp2, ln and log2 of any lane: against correctly rounded values, against `libm`, and packs
//! against single numbers. Out of scope: payloads of NaNs.

use lahar::lane::{Dual, Lane, Pack, powers};
use proptest::prelude::*;

/// Bits as a number that grows with the value: neighbours differ by one, ±0 are the same.
fn rank(x: f64) -> i64 {
    let bits = x.to_bits() as i64;
    if bits < 0 { i64::MIN.wrapping_sub(bits) } else { bits }
}

fn distance(a: f64, b: f64) -> u64 {
    rank(a).abs_diff(rank(b))
}

/// Pairs (x, f(x)) of a function; its file says where they are from.
fn rounded(name: &str) -> Vec<[f64; 2]> {
    let lines = include_str!("common/rounded_powers.txt").lines().filter(|line| !line.starts_with('#'));
    let bits =
        |word: &str| f64::from_bits(u64::from_str_radix(word, 16).expect("sixteen hexadecimal digits"));
    let of_name = lines.filter_map(|line| line.strip_prefix(name)?.strip_prefix(' ')?.split_once(' '));
    of_name.map(|(x, value)| [bits(x), bits(value)]).collect()
}

/// An error below one unit in the last place leaves the right result or one of its neighbours. Gives
/// the share of right results. `count`: of the pairs in the file, so that none is passed over.
fn against_rounded(name: &str, count: usize, function: impl Fn(f64) -> f64) {
    let table = rounded(name);
    assert_eq!(table.len(), count, "{name}");
    let mut right = 0;
    for [x, wanted] in table {
        let found = function(x);
        assert!(distance(found, wanted) <= 1, "{name}({x:e}): {found:e}, not {wanted:e}");
        right += usize::from(found == wanted);
    }
    // Errors of at most 0.8 units that spread evenly miss the nearest number in less than a fifth.
    assert!(5 * right >= 4 * count, "{name}: {right} of {count}");
}

#[test]
fn correctly_rounded_or_a_neighbour() {
    against_rounded("exp", 247, powers::exp);
    against_rounded("exp2", 250, powers::exp2);
    against_rounded("ln", 215, powers::ln);
    against_rounded("log2", 214, powers::log2);
}

#[test]
fn limit_special_values() {
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    for exp in [powers::exp::<f64>, powers::exp2::<f64>] {
        assert_eq!([exp(inf), exp(1e300), exp(1024.0)], [inf; 3]);
        assert_eq!([exp(-inf), exp(-1e300), exp(-1076.0)], [0.0; 3]);
        assert_eq!([exp(0.0), exp(-0.0), exp(5e-324), exp(-1e-300)], [1.0; 4]);
        assert!(exp(nan).is_nan());
    }
    for ln in [powers::ln::<f64>, powers::log2::<f64>] {
        assert_eq!([ln(0.0), ln(-0.0)], [-inf; 2]);
        assert_eq!((ln(inf), ln(1.0).to_bits()), (inf, 0));
        for x in [-5e-324, -1.0, f64::MIN, -inf, nan] {
            assert!(ln(x).is_nan(), "{x}");
        }
    }
    for k in -1074..=1023 {
        let k = f64::from(k);
        let power = 1.0.scale_by_power_of_two(k);
        assert_eq!((powers::exp2(k), powers::log2(power)), (power, k));
        assert_eq!(power, libm::exp2(k));
    }
    assert!(powers::exp(f64::from_bits(0x4086_2e42_fefa_39ef)).is_finite());
}

#[test]
fn limit_primitives() {
    assert_eq!(3.0.scale_by_power_of_two(2000.0), f64::INFINITY);
    assert_eq!((-3.0).scale_by_power_of_two(1e9), f64::NEG_INFINITY);
    assert_eq!(3.0.scale_by_power_of_two(-3000.0), 0.0);
    assert_eq!(f64::MAX.scale_by_power_of_two(-2044.0), libm::ldexp(f64::MAX, -2044));
    assert_eq!(5e-324.scale_by_power_of_two(1074.0), 1.0);
    assert_eq!(f64::MIN_POSITIVE.exponent_mantissa(), (-1022.0, 1.0));
    assert_eq!(f64::MAX.exponent_mantissa(), (1023.0, 2.0_f64.next_down()));
    assert_eq!(12.0.exponent_mantissa(), (3.0, 1.5));
    let table = [[1.0, 10.0], [2.0, 20.0], [3.0, 30.0]];
    let at = |x: f64| x.lookup(&table)[1];
    assert_eq!([at(0.0), at(0.99), at(1.0), at(1.99), at(2.5)], [10.0, 10.0, 20.0, 20.0, 30.0]);
    assert_eq!([at(-0.0), at(-7.0), at(f64::NAN), at(f64::NEG_INFINITY)], [10.0; 4]);
    assert_eq!([at(3.0), at(1e18), at(f64::INFINITY)], [30.0; 3]);
    assert!(1.0_f64.lookup::<2>(&[])[0].is_nan());
    // Derivatives of the primitives: 8 = 2³ · 1, d/dx of the mantissa is 2⁻³.
    let (exponent, mantissa) = Dual::variable(8.0).exponent_mantissa();
    assert_eq!((exponent, mantissa), (Dual::constant(3.0), Dual { value: 1.0, slope: 0.125 }));
    let scaled = Dual::variable(1.5).scale_by_power_of_two(Dual::constant(4.0));
    assert_eq!(scaled, Dual { value: 24.0, slope: 16.0 });
    assert_eq!(Dual::variable(1.5).lookup(&table), [2.0, 20.0].map(Dual::constant));
}

/// Everything a pack computes, for parity.
fn everything<L: Lane>(x: L) -> Vec<L> {
    let (exponent, mantissa) = x.exponent_mantissa();
    let [a, b, c] = x.lookup(&[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0], [0.5, 0.25, 0.125]]);
    let near = powers::nearest(x);
    vec![
        powers::exp(x),
        powers::exp2(x),
        powers::ln(x),
        powers::log2(x),
        powers::ln_of_positive(x),
        x.exp(),
        x.ln(),
        x.exp_m1(),
        exponent,
        mantissa,
        a,
        b,
        c,
        near,
        mantissa.scale_by_power_of_two(near),
    ]
}

fn same_bits(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

fn parity<const N: usize>(x: [f64; N]) {
    let together = everything(Pack(x));
    for (lane, x) in x.into_iter().enumerate() {
        for (k, (alone, packed)) in everything(x).into_iter().zip(&together).enumerate() {
            let packed = packed.0[lane];
            assert!(same_bits(alone, packed), "output {k} of {x:e}: {alone:e} {packed:e}");
        }
    }
}

#[test]
fn parity_of_special_values() {
    let (inf, tiny) = (f64::INFINITY, f64::MIN_POSITIVE);
    parity([0.0, -0.0, inf, -inf, f64::NAN, -f64::NAN, 1.0, -1.0]);
    parity([tiny, -tiny, tiny.next_down(), 5e-324, -5e-324, f64::MAX, f64::MIN, 1e-300]);
    parity([709.78, 709.79, -745.13, -745.14, 1023.9, 1024.0, -1074.9, -1075.1]);
    parity([1.0_f64.next_up(), 1.0_f64.next_down(), 0.5, 1.5, 2.5, -0.5, 2.0, 1e18]);
    parity([0.3, 700.0]);
    parity([f64::NAN, 1.0, 1.0, f64::NAN]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn parity_of_any_bits(x in prop::array::uniform8(any::<u64>())) {
        parity(x.map(f64::from_bits));
    }

    #[test]
    fn parity_of_moderate_numbers(x in prop::array::uniform8(-800.0_f64..1100.0)) {
        parity(x);
    }

    /// Both are within one unit of the exact value.
    #[test]
    fn agrees_with_libm(x in -745.0_f64..709.7, y in -40.0_f64..40.0, bits in 1_u64..0x7ff0_0000_0000_0000, z in 0.5_f64..2.0) {
        for x in [x, y] {
            prop_assert!(distance(powers::exp(x), libm::exp(x)) <= 2, "exp {x:e}");
            prop_assert!(distance(powers::exp2(x), libm::exp2(x)) <= 2, "exp2 {x:e}");
        }
        for x in [f64::from_bits(bits), z] {
            prop_assert!(distance(powers::ln(x), libm::log(x)) <= 2, "ln {x:e}");
            prop_assert!(distance(powers::log2(x), libm::log2(x)) <= 2, "log2 {x:e}");
            prop_assert_eq!(powers::ln(x).to_bits(), powers::ln_of_positive(x).to_bits());
        }
    }

    /// A larger argument never gives a result lower by more than the two errors, less than a unit each.
    #[test]
    fn monotone_on_neighbours(x in -740.0_f64..709.0, near in -1.0_f64..1.0, bits in 1_u64..0x7fef_ffff_ffff_ffff) {
        for x in [x, near] {
            for exp in [powers::exp::<f64>, powers::exp2::<f64>] {
                prop_assert!(rank(exp(x.next_up())) >= rank(exp(x)) - 1, "{x:e}");
            }
        }
        for x in [f64::from_bits(bits), 1.0 + 0.3 * near] {
            for ln in [powers::ln::<f64>, powers::log2::<f64>] {
                prop_assert!(rank(ln(x.next_up())) >= rank(ln(x)) - 1, "{x:e}");
            }
        }
    }

    /// A unit of the logarithm, at most |ln x| ε, is a relative error of x.
    #[test]
    fn exp_of_ln(bits in 0x0010_0000_0000_0000_u64..0x7fef_ffff_ffff_ffff) {
        let x = f64::from_bits(bits);
        let (back, back2) = (powers::exp(powers::ln(x)), powers::exp2(powers::log2(x)));
        let bound = |log: f64| (1.0 + log.abs()) * f64::EPSILON * x;
        // At the upper end the logarithm may round to one whose power overflows.
        prop_assume!(back.is_finite() && back2.is_finite());
        prop_assert!((back - x).abs() <= bound(powers::ln(x)), "{x:e}");
        prop_assert!((back2 - x).abs() <= bound(powers::log2(x)), "{x:e}");
    }

    /// Chain rule, with the bits of the single number in the value.
    #[test]
    fn derivatives(x in 1e-3_f64..50.0) {
        let (exp, ln) = (Lane::exp(Dual::variable(x)), Lane::ln(Dual::variable(x)));
        prop_assert_eq!((exp.value, exp.slope), (powers::exp(x), powers::exp(x)));
        prop_assert_eq!((ln.value, ln.slope), (powers::ln(x), 1.0 / x));
    }
}
