//! Reads pictures back, as far as tests of them need.

#![allow(dead_code, reason = "each user needs part of it")]

/// An element of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Element<'a> {
    attributes: &'a str,
    /// What follows its first tag.
    pub text: &'a str,
}

/// All elements of this name, in the order they are drawn.
pub fn elements<'a>(svg: &'a str, name: &str) -> Vec<Element<'a>> {
    let element = |piece: &'a str| {
        let (head, text) = piece.split_once('>')?;
        let attributes = head.strip_prefix(name)?;
        attributes.starts_with([' ', '\n']).then_some(Element { attributes, text: text.trim() })
    };
    svg.split('<').filter_map(element).collect()
}

impl<'a> Element<'a> {
    /// An attribute.
    pub fn word(&self, key: &str) -> Option<&'a str> {
        self.attributes.split_once(&format!(" {key}=\""))?.1.split('"').next()
    }

    /// An attribute that is a number.
    pub fn number(&self, key: &str) -> f64 {
        let found = self.word(key).and_then(|word| word.parse().ok());
        found.unwrap_or_else(|| panic!("no number {key} in {}", self.attributes))
    }

    /// The place of a text or a rectangle, pixels.
    pub fn place(&self) -> [f64; 2] {
        [self.number("x"), self.number("y")]
    }

    /// Corners of a line, pixels.
    pub fn points(&self) -> Vec<[f64; 2]> {
        let pair = |pair: &str| {
            let (x, y) = pair.split_once(',').expect("x,y");
            [x.parse().expect("a number"), y.parse().expect("a number")]
        };
        self.word("points").expect("points").split_whitespace().map(pair).collect()
    }
}

/// A rectangle, pixels.
#[derive(Clone, Copy, Debug)]
pub struct Area {
    corner: [f64; 2],
    /// Width and height.
    pub size: [f64; 2],
}

impl Area {
    pub fn of(rectangle: &Element<'_>) -> Self {
        Self { corner: rectangle.place(), size: ["width", "height"].map(|key| rectangle.number(key)) }
    }

    /// The frame of a picture: its only rectangle that is not filled.
    pub fn frame(svg: &str) -> Self {
        let frames = elements(svg, "rect").into_iter().filter(|r| r.word("fill") == Some("none"));
        let frames: Vec<Self> = frames.map(|frame| Self::of(&frame)).collect();
        assert_eq!(frames.len(), 1);
        frames[0]
    }

    /// Shares of the width, from the left, and of the height, from below.
    pub fn shares(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [(x - self.corner[0]) / self.size[0], (self.corner[1] + self.size[1] - y) / self.size[1]]
    }

    /// The pixel at such shares.
    pub fn pixel(&self, [across, up]: [f64; 2]) -> [f64; 2] {
        [self.corner[0] + across * self.size[0], self.corner[1] + (1.0 - up) * self.size[1]]
    }

    pub fn holds(&self, at: [f64; 2]) -> bool {
        self.shares(at).iter().all(|share| (0.0..1.0).contains(share))
    }
}

/// What is painted at shares of the frame's width and height: the colour of the last opaque rectangle there.
pub fn painted<'a>(svg: &'a str, at: [f64; 2]) -> Option<&'a str> {
    let at = Area::frame(svg).pixel(at);
    let filled = |r: &Element<'a>| r.word("width") != Some("100%") && r.word("fill-opacity").is_none();
    let there = elements(svg, "rect").into_iter().filter(filled).filter(|r| Area::of(r).holds(at));
    there.filter_map(|r| r.word("fill")).rfind(|fill| *fill != "none")
}

/// Red, green and blue of `#rrggbb`.
pub fn rgb(colour: &str) -> [f64; 3] {
    let part = |k: usize| u8::from_str_radix(&colour[k..k + 2], 16).expect("two digits");
    [1, 3, 5].map(|k| f64::from(part(k)))
}

/// The number that a label shows: `0.25`, `10⁻³`, `2.5×10⁷`.
pub fn value(label: &str) -> f64 {
    let plain = |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|digit| digit == c);
    let power = |digits: &str| {
        let digit =
            |c: char| if c == '⁻' { "-".to_owned() } else { plain(c).expect("a power").to_string() };
        digits.chars().map(digit).collect::<String>()
    };
    let text = match label.split_once("10") {
        Some((factor, high)) if high.starts_with(|c| c == '⁻' || plain(c).is_some()) => {
            let factor = if factor.is_empty() { "1" } else { factor.trim_end_matches('×') };
            format!("{factor}e{}", power(high))
        }
        _ => label.to_owned(),
    };
    text.parse().unwrap_or_else(|_| panic!("{label} is no number"))
}
