//! A check that a document is well-formed enough for any XML reader: balanced
//! tags, quoted attributes, no bare `<` or `&`.

/// What is wrong with a document, if anything is.
pub(crate) fn fault(document: &str) -> Option<String> {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = document;
    while let Some((text, tail)) = rest.split_once('<') {
        if let Some(fault) = bare_ampersand(text) {
            return Some(fault);
        }
        let Some((tag, after)) = tail.split_once('>') else {
            return Some(format!("unclosed tag: <{}", head(tail)));
        };
        rest = after;
        if let Some(name) = tag.strip_prefix('/') {
            if open.pop() != Some(name) {
                return Some(format!("</{name}> closes nothing"));
            }
            continue;
        }
        let (body, alone) = tag.strip_suffix('/').map_or((tag, false), |body| (body, true));
        let (name, attributes) = body.split_once(' ').unwrap_or((body, ""));
        let well_named = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric());
        if !well_named || attributes.matches('"').count() % 2 != 0 || attributes.contains('<') {
            return Some(format!("malformed tag: <{}", head(tag)));
        }
        if let Some(fault) = bare_ampersand(attributes) {
            return Some(fault);
        }
        if !alone {
            open.push(name);
        }
    }
    open.pop().map(|name| format!("<{name}> is never closed"))
}

fn bare_ampersand(text: &str) -> Option<String> {
    let entity = |tail: &str| {
        tail.split_once(';')
            .is_some_and(|(name, _)| ["amp", "lt", "gt", "quot", "apos"].contains(&name))
    };
    text.split('&').skip(1).find(|tail| !entity(tail)).map(|tail| format!("bare &: {}", head(tail)))
}

fn head(text: &str) -> String {
    text.chars().take(60).collect()
}
