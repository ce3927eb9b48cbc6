"""What a report for people says about rules. `report.html` and `report.document.markdown` show it."""
