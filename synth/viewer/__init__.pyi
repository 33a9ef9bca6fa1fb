from synth.viewer.pages import page as page
from synth.viewer.shown import Shown as Shown, shown_of as shown_of
