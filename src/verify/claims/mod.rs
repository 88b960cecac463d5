//! All claims, by topic.
