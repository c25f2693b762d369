error({reason = "a table"})
