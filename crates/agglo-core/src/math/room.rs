//! Room for columns that are filled anew again and again, with little to spare.

/// Part by which a column that must grow gets more room than it needs.
const SPARE: usize = 16;

/// Makes room for so many items in all. A vector that grows by itself doubles its room, and holds what it had and what it gets side by
/// side; this one lets what it had go first if it is `stale`.
fn make_room<T>(column: &mut Vec<T>, count: usize, stale: bool) {
    if column.capacity() < count {
        if stale {
            *column = Vec::new();
        }
        column.reserve_exact(count + count / SPARE - column.len());
    }
}

/// Fills a column with so many of the same; what it had is lost.
pub fn refill<T: Clone>(column: &mut Vec<T>, count: usize, with: T) {
    column.clear();
    make_room(column, count, true);
    column.resize(count, with);
}

/// Makes room for so many items in all beside those that a column has.
pub fn make_room_for<T>(column: &mut Vec<T>, count: usize) {
    make_room(column, count, false);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn room_grows_by_little_and_is_kept() {
        let mut column = vec![7; 100];
        refill(&mut column, 101, 1);
        assert_eq!(column, [1; 101]);
        let room = column.capacity();
        assert!((101..=107).contains(&room), "{room}: a sixteenth to spare");
        refill(&mut column, 3, 2);
        assert_eq!((&column[..], column.capacity()), (&[2; 3][..], room));
        make_room_for(&mut column, 1000);
        assert_eq!(column, [2; 3]);
        assert!((1000..=1062).contains(&column.capacity()), "{}", column.capacity());
    }
}
