from synth.viewer.pages import ViewPage as ViewPage, page as page, view as view
from synth.viewer.shown import Shown as Shown, shown_of as shown_of
