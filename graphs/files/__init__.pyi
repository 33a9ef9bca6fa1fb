from graphs.files.formats import Entry as Entry, read as read, read_all as read_all, write as write
