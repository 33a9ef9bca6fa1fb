"""The page of a mechanism as a widget of a notebook, by anywidget: the extra ``notebook``.

The page stands in a frame without access to the notebook, so its scripts reach nothing but the page.
"""

import anywidget
import traitlets

_SCRIPT = """
function render({ model, el }) {
  const frame = document.createElement("iframe");
  frame.setAttribute("sandbox", "allow-scripts allow-downloads");
  frame.style.cssText = "width: 100%; border: 0";
  const shown = () => { frame.srcdoc = model.get("html"); };
  const sized = () => { frame.style.height = `${model.get("height")}px`; };
  model.on("change:html", shown);
  model.on("change:height", sized);
  shown();
  sized();
  el.append(frame);
}
export default { render };
"""


class PageWidget(anywidget.AnyWidget):
    """An interactive page in a notebook; `html` is the page, `height` that of the frame in pixels.

    Examples
    --------
    >>> PageWidget(html="<p>a page</p>", height=400).height
    400
    """

    _esm = _SCRIPT
    html = traitlets.Unicode().tag(sync=True)
    height = traitlets.Int(600).tag(sync=True)
