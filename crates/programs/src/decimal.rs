//! Numbers of a program as they were written: whole counts of a decimal place, so that text and value agree exactly.

/// More digits than this are not read: they would not fit the exact whole numbers of a double.
const MOST_DIGITS: u32 = 15;

/// A decimal number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Decimal {
    digits: i64,
    /// Digits behind the point, at most [`MOST_DIGITS`].
    pub(crate) places: u8,
    /// Whether it was written with a point.
    pub(crate) has_point: bool,
}

impl Decimal {
    /// The number whose characters are `text`: sign, digits, point. None when it has no digit or too many.
    pub(crate) fn read(text: impl IntoIterator<Item = u8>) -> Option<Self> {
        let (mut digits, mut count, mut places, mut has_point) = (0_i64, 0, 0, false);
        let (mut negative, mut any) = (false, false);
        for byte in text {
            match byte {
                b'-' => negative = !negative,
                b'+' => {}
                b'.' => has_point = true,
                _ => {
                    any = true;
                    if count > 0 || byte != b'0' {
                        count += 1;
                    }
                    places += u32::from(has_point);
                    if count > MOST_DIGITS || places > MOST_DIGITS {
                        return None;
                    }
                    digits = digits * 10 + i64::from(byte - b'0');
                }
            }
        }
        let digits = if negative { -digits } else { digits };
        any.then_some(Self { digits, places: places as u8, has_point })
    }

    pub(crate) fn value(self) -> f64 {
        self.digits as f64 / 10_f64.powi(i32::from(self.places))
    }

    pub(crate) fn is_zero(self) -> bool {
        self.digits == 0
    }

    /// The number as a count of the last of so many decimal places; none when it needs more, or is too large.
    pub(crate) fn count(self, places: u8) -> Option<i64> {
        if places >= self.places {
            return self.digits.checked_mul(10_i64.checked_pow(u32::from(places - self.places))?);
        }
        let unit = 10_i64.checked_pow(u32::from(self.places - places))?;
        (self.digits % unit == 0).then_some(self.digits / unit)
    }

    /// The number if it is whole and not negative.
    pub(crate) fn whole(self) -> Option<u32> {
        u32::try_from(self.count(0)?).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_they_are_written() {
        for (text, value, places) in
            [("X.5", 0.5, 1), ("-1", -1.0, 0), ("+2.", 2.0, 0), ("007.250", 7.25, 3), ("-.0", 0.0, 1)]
        {
            let decimal = Decimal::read(text.bytes().filter(|byte| *byte != b'X')).expect(text);
            assert_eq!((decimal.value(), decimal.places), (value, places), "{text}");
        }
        for text in ["", ".", "-", "1234567890123456", "0.0000000000000001"] {
            assert_eq!(Decimal::read(text.bytes()), None, "{text}");
        }
    }

    #[test]
    fn counts_are_exact() {
        let decimal = Decimal::read(*b"12.50").expect("a number");
        assert_eq!((decimal.count(3), decimal.count(1), decimal.count(0)), (Some(12500), Some(125), None));
        assert_eq!(decimal.count(18), None);
    }
}
