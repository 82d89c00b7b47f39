echo "not ok: one case"
echo "1 passed, 1 failed"
exit 1
