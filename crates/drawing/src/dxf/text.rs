//! Text of a file: its encoding and its escapes.

use encoding_rs::{Encoding, WINDOWS_1252};

/// How text is spelled that is not UTF-8.
#[derive(Clone, Copy, Debug)]
pub(super) struct TextCoding(&'static Encoding);

impl Default for TextCoding {
    /// Western European, as most programs write without saying so.
    fn default() -> Self {
        Self(WINDOWS_1252)
    }
}

impl TextCoding {
    /// The encoding that `$DWGCODEPAGE` names, such as `ANSI_1250` or `ANSI_932`; the default for any other name.
    pub(super) fn of_code_page(name: &[u8]) -> Self {
        let name = String::from_utf8_lossy(name).to_ascii_lowercase();
        let number = name.strip_prefix("ansi_").unwrap_or(&name);
        let label = match number {
            "932" => "shift_jis".to_owned(),
            "936" => "gbk".to_owned(),
            "949" => "euc-kr".to_owned(),
            "950" => "big5".to_owned(),
            _ => format!("windows-{number}"),
        };
        Encoding::for_label(label.as_bytes()).map_or_else(Self::default, Self)
    }

    /// The text: UTF-8 where it is valid, the file's code page otherwise; `\U+XXXX` escapes become their letters.
    pub(super) fn decode(self, bytes: &[u8]) -> String {
        let text = match std::str::from_utf8(bytes) {
            Ok(text) => text.to_owned(),
            Err(_) => self.0.decode_without_bom_handling(bytes).0.into_owned(),
        };
        if text.contains("\\U+") { without_escapes(&text) } else { text }
    }
}

/// Escapes that are not four hexadecimal digits of a letter are left as they stand.
fn without_escapes(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("\\U+") {
        plain.push_str(before);
        let digits = after.get(..4).filter(|digits| digits.bytes().all(|b| b.is_ascii_hexdigit()));
        let letter = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok()).and_then(char::from_u32);
        if let Some(letter) = letter {
            plain.push(letter);
            rest = &after[4..];
        } else {
            plain.push_str("\\U+");
            rest = after;
        }
    }
    plain + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_utf_8_or_of_the_code_page() {
        let western = TextCoding::default();
        assert_eq!(western.decode("Fräser".as_bytes()), "Fräser");
        assert_eq!(western.decode(b"Fr\xe4ser \x80"), "Fräser €");
        assert_eq!(TextCoding::of_code_page(b"ANSI_1250").decode(b"\xb3\xf3d\x9f"), "łódź");
        assert_eq!(TextCoding::of_code_page(b"ansi_932").decode(b"\x90\xd8\x92f"), "切断");
        assert_eq!(TextCoding::of_code_page(b"dos437").decode(b"\xe4"), "ä");
    }

    #[test]
    fn escapes_become_letters() {
        let text = TextCoding::default().decode(b"\\U+00D6l \\U+4e2d\\U+ \\U+12\\U+D800\\U+00e");
        assert_eq!(text, "Öl 中\\U+ \\U+12\\U+D800\\U+00e");
    }
}
