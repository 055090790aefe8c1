"""`ion report`: one drive as a page that anybody can open."""
