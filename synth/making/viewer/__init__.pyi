from synth.making.viewer.page_data import Shown as Shown, shown_of as shown_of
from synth.making.viewer.pages import ViewPage as ViewPage, page as page, view as view
