/// The word of `known` that `found` most likely meant, if any is near.
pub(super) fn nearest<'a>(found: &str, known: &[&'a str]) -> Option<&'a str> {
    let distance = |word: &&str| edit_distance(found, word);
    let best = known.iter().copied().min_by_key(distance)?;
    (edit_distance(found, best) <= found.chars().count().max(best.chars().count()) / 2)
        .then_some(best)
}

/// Insertions, deletions and substitutions between two words (Levenshtein, 1966).
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_pen_finds_its_word() {
        let known = ["viscosity", "stiffness", "mass"];
        assert_eq!(nearest("viscosty", &known), Some("viscosity"));
        assert_eq!(nearest("mas", &known), Some("mass"));
        assert_eq!(nearest("temperature", &known), None);
        assert_eq!(edit_distance("kitten", "sitting"), 3);
    }
}
