"""A person without a mouse: where Tab leads, whether the place is seen, and Enter."""

from __future__ import annotations

from typing import Any

FURTHEST = 250
"""Stops of Tab after which nobody would go on."""

CONTROLS = """() => {
  const found = new Set(), folded = [...document.querySelectorAll("details")], were = folded.map((one) => one.open);
  const name = (one) => one.type === "radio" ? `radio ${one.name}` : one.outerHTML.slice(0, 160);
  const gather = () => {
    for (const one of document.querySelectorAll("a[href], button, input, select, textarea, summary")) {
      if (!one.checkVisibility({ visibilityProperty: true }) || one.disabled) continue;
      if (one.type === "hidden" || one.tabIndex < 0 || one.closest("svg[aria-hidden=true], [inert]")) continue;
      found.add(name(one));
    }
  };
  gather();
  for (const one of folded.filter((one) => !one.open && !one.matches("[hx-get]"))) {
    for (let at = one; at; at = at.parentElement.closest("details")) at.open = true;
    gather();
    folded.forEach((other, k) => { other.open = were[k]; });
  }
  return [...found];
}"""
"""Each of a group of radio buttons is one; what is folded counts, but for what the server sends when it is unfolded."""
FOCUSED = """() => {
  const one = document.activeElement;
  if (!one || one === document.body) return null;
  const style = getComputedStyle(one);
  const seen = one.type === "date" ||  // whose parts the browser marks by itself
    (style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0) || style.boxShadow !== "none";
  const folded = one.matches("details:not([open]):not([hx-get]) > summary");
  return [one.type === "radio" ? `radio ${one.name}` : one.outerHTML.slice(0, 160), seen, folded];
}"""


def not_reached(page: Any) -> list[str]:
    """Controls of a page that Tab does not lead to, or where one does not see that it did; what is folded Enter unfolds."""
    missing, unseen = set(page.evaluate(CONTROLS)), []
    page.evaluate("document.activeElement.blur()")
    for _ in range(len(missing) + 60):
        if not missing:
            break
        page.keyboard.press("Tab")
        at = page.evaluate(FOCUSED)
        if at is None:
            continue
        missing.discard(at[0])
        if not at[1]:
            unseen.append(f"focus is not seen: {at[0]}")
        if at[2]:
            page.keyboard.press("Enter")
    return [*(f"not reached: {one}" for one in sorted(missing)), *dict.fromkeys(unseen)]


def tab_to(page: Any, wanted: Any) -> None:
    """Press Tab until a control has the focus, forwards from where one is; the focus must be seen there."""
    wanted.wait_for(state="visible")  # a part that is swapped in again and again keeps the focus by an id
    for _ in range(FURTHEST):
        if wanted.evaluate("one => one === document.activeElement"):
            assert wanted.page.evaluate("document.activeElement.matches(':focus-visible')"), "the focus is not seen"
            return
        page.keyboard.press("Tab")
    raise AssertionError(f"Tab does not lead to {wanted}")


def press(page: Any, wanted: Any) -> None:
    """Go to a link or a button by Tab, and press Enter there."""
    tab_to(page, wanted)
    page.keyboard.press("Enter")


def send(page: Any, wanted: Any) -> None:
    """The same, where another page follows; what htmx swaps in meanwhile is none."""
    tab_to(page, wanted)
    with page.expect_event("load"):
        page.keyboard.press("Enter")


def write(page: Any, field: Any, text: str) -> None:
    """Go to a field by Tab, and type."""
    tab_to(page, field)
    page.keyboard.press("ControlOrMeta+A")
    page.keyboard.type(text)


def choose(page: Any, field: Any, value: str) -> None:
    """Go to a list of choices by Tab, and to one of them by the arrows."""
    tab_to(page, field)
    there = field.evaluate("(one, value) => [...one.options].findIndex(own => own.value === value)", value)
    assert there >= 0, f"{value!r} is no choice"
    page.keyboard.press("Home")
    for _ in range(there):
        page.keyboard.press("ArrowDown")
    assert field.input_value() == value
