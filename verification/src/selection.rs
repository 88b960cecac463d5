//! Which claims to evaluate.

use crate::claim::Claim;
use crate::claims::studies;
use crate::ladder::Depth;

/// Some of the claims, in the order of the report, and how much of their ladders.
#[derive(Clone, Debug)]
pub struct Selection {
    claims: Vec<&'static Claim>,
    depth: Depth,
}

/// A name that selects nothing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SelectionError {
    /// No claim has this id.
    #[error("there is no claim `{id}`{}", suggestion(.nearest))]
    Claim { id: String, nearest: Vec<&'static str> },
    /// No study has this id.
    #[error("there is no chapter `{chapter}`; there are {}", known.join(", "))]
    Chapter { chapter: String, known: Vec<&'static str> },
    /// No claim has this tag.
    #[error(
        "no claim has the tag `{tag}`; tags are those of docs/method.md (`Y3`), hard cases (`H2`) or `000 Eq 14`"
    )]
    Tag { tag: String },
}

fn suggestion(ids: &[&str]) -> String {
    if ids.is_empty() { String::new() } else { format!("; did you mean {}?", ids.join(", ")) }
}

impl Selection {
    /// Every claim of every study.
    #[must_use]
    pub fn all() -> Self {
        Self { claims: every().collect(), depth: Depth::Short }
    }

    /// The claims with these ids, `poiseuille-bingham`.
    ///
    /// # Errors
    /// [`SelectionError::Claim`] for an id that no claim has.
    pub fn ids<S: AsRef<str>>(ids: impl IntoIterator<Item = S>) -> Result<Self, SelectionError> {
        let ids: Vec<S> = ids.into_iter().collect();
        if let Some(unknown) = ids.iter().map(AsRef::as_ref).find(|id| every().all(|c| c.id != *id)) {
            let similar = |c: &&Claim| c.id.contains(unknown) || shared(c.id, unknown) >= 8;
            let mut nearest: Vec<&str> = every().filter(similar).map(|c| c.id).collect();
            nearest.sort_by_key(|id| std::cmp::Reverse(shared(id, unknown)));
            nearest.truncate(5);
            return Err(SelectionError::Claim { id: unknown.to_owned(), nearest });
        }
        Ok(Self::of(|claim| ids.iter().any(|id| id.as_ref() == claim.id)))
    }

    /// The claims of one study, `poiseuille`.
    ///
    /// # Errors
    /// [`SelectionError::Chapter`] if there is no such study.
    pub fn chapter(id: &str) -> Result<Self, SelectionError> {
        match studies().iter().find(|s| s.id == id) {
            Some(study) => Ok(Self { claims: study.claims.iter().collect(), depth: Depth::Short }),
            None => {
                let known = studies().iter().map(|s| s.id).collect();
                Err(SelectionError::Chapter { chapter: id.to_owned(), known })
            }
        }
    }

    /// The claims with this tag, `Y3` or `004 Eq 3.55`.
    ///
    /// # Errors
    /// [`SelectionError::Tag`] if no claim has it.
    pub fn tag(tag: &str) -> Result<Self, SelectionError> {
        let found = Self::of(|claim| claim.tags.contains(&tag));
        if found.claims.is_empty() { Err(SelectionError::Tag { tag: tag.to_owned() }) } else { Ok(found) }
    }

    /// These claims on their full ladders: minutes to hours where the short ones take seconds.
    #[must_use]
    pub fn full(self) -> Self {
        Self { depth: Depth::Full, ..self }
    }

    /// The claims.
    #[must_use]
    pub fn claims(&self) -> &[&'static Claim] {
        &self.claims
    }

    /// How much of their ladders.
    #[must_use]
    pub fn depth(&self) -> Depth {
        self.depth
    }

    fn of(wanted: impl Fn(&Claim) -> bool) -> Self {
        Self { claims: every().filter(|c| wanted(c)).collect(), depth: Depth::Short }
    }
}

fn every() -> impl Iterator<Item = &'static Claim> {
    studies().iter().flat_map(|s| s.claims)
}

/// Length of the common beginning of two ids.
fn shared(a: &str, b: &str) -> usize {
    a.bytes().zip(b.bytes()).take_while(|(x, y)| x == y).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selects_by_id_chapter_and_tag() {
        let two = Selection::ids(["moment-identities", "couette-all-laws"]).unwrap();
        assert_eq!(two.claims().len(), 2);
        assert_eq!(two.depth(), Depth::Short);
        assert_eq!(two.full().depth(), Depth::Full);
        let chapter = Selection::chapter("poiseuille").unwrap();
        assert!(chapter.claims().iter().any(|c| c.id == "poiseuille-bingham"));
        assert!(Selection::tag("Y3").unwrap().claims().iter().all(|c| c.tags.contains(&"Y3")));
        assert!(Selection::all().claims().len() > chapter.claims().len());
    }

    #[test]
    fn unknown_names_are_refused_with_what_there_is() {
        let text = Selection::ids(["poiseuille-binghm"]).unwrap_err().to_string();
        assert!(text.contains("`poiseuille-binghm`") && text.contains("poiseuille-bingham"), "{text}");
        let text = Selection::chapter("pipes").unwrap_err().to_string();
        assert!(text.contains("poiseuille"), "{text}");
        assert_eq!(Selection::tag("Z9").unwrap_err(), SelectionError::Tag { tag: "Z9".to_owned() });
    }
}
